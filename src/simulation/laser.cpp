// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/simulation/laser.hpp"
