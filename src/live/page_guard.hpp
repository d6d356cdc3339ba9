// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace cca {

/// Decides which requests come from somebody who may look at the run or drive its robot.
///
/// Any page that is open in a browser may send requests to a server of the same machine. It cannot
/// hide its origin, nor read what does not name it; a name of its own that it has pointed at
/// 127.0.0.1 stands in the Host header ("DNS rebinding").
class PageGuard {
 public:
  /// @param token  empty: who is on this machine needs none.
  PageGuard(std::string address, int port, std::string token);

  struct Request {
    std::string host, origin;  ///< as in the headers; empty: none
    std::string token;
  };
  /// Why a request is refused; empty: it may look.
  std::string whyNotLook(const Request& request) const;
  /// The same for commands: they must name the page that was served as their origin.
  std::string whyNotCommand(const Request& request) const;

 private:
  std::string address_, port_, token_;
};

/// 128 random bits, as text. @throws std::runtime_error where the system has none.
std::string randomToken();

}  // namespace cca
