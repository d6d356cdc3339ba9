// SPDX-License-Identifier: BSD-3-Clause
#include "page_guard.hpp"

#include <cstdio>
#include <random>
#include <utility>

namespace cca {
namespace {

/// In a time that does not tell how many of the letters are right.
bool isSame(const std::string& given, const std::string& token) {
  unsigned different = given.size() == token.size() ? 0 : 1;
  for (std::size_t i = 0; i < token.size(); ++i) {
    const char letter = i < given.size() ? given[i] : '\0';
    different |= static_cast<unsigned char>(letter) ^ static_cast<unsigned char>(token[i]);
  }
  return different == 0;
}

}  // namespace

PageGuard::PageGuard(std::string address, int port, std::string token)
    : address_(std::move(address)), port_(std::to_string(port)), token_(std::move(token)) {}

std::string PageGuard::whyNotLook(const Request& request) const {
  const bool is_ours =
      request.host == address_ + ":" + port_ || request.host == "localhost:" + port_;
  if (token_.empty() && !is_ours) return "the Host header names another server";
  if (!request.origin.empty() && request.origin != "http://" + request.host) {
    return "pages of another origin are not served";
  }
  if (!token_.empty() && !isSame(request.token, token_)) return "the token is missing or wrong";
  return "";
}

std::string PageGuard::whyNotCommand(const Request& request) const {
  if (request.origin.empty()) return "a command names its origin";
  return whyNotLook(request);
}

std::string randomToken() {
  std::random_device random;
  std::string token;
  for (int k = 0; k < 4; ++k) {
    char part[9];
    std::snprintf(part, sizeof part, "%08x", static_cast<unsigned>(random()));
    token += part;
  }
  return token;
}

}  // namespace cca
