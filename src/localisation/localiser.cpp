// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/localisation/localiser.hpp"

namespace cca {

void doInTurn(int count, const std::function<void(int)>& task) {
  for (int k = 0; k < count; ++k) task(k);
}

}  // namespace cca
