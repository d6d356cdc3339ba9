// SPDX-License-Identifier: BSD-3-Clause
#include "live/live_page.hpp"

#include <stdexcept>

#include "io/files/late_library.hpp"

namespace cca {

std::unique_ptr<LivePage> openLivePage(const LivePageSettings& settings) {
  using Open = LivePage*(const LivePageSettings&);
  Open* open = nullptr;
  try {
    open = reinterpret_cast<Open*>(lateFunction("libcca_page_server.so", "openServedPage"));
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(std::string("no live page: the program was built without "
                                         "cpp-httplib; install libcpp-httplib-dev and build it "
                                         "anew (") +
                             error.what() + ")");
  }
  return std::unique_ptr<LivePage>(open(settings));
}

}  // namespace cca
