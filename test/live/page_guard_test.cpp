// SPDX-License-Identifier: BSD-3-Clause
#include "live/page_guard.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace cca::page_guard_test {
namespace {

const std::string kToken = "0123456789abcdef0123456789abcdef";

bool mayLook(const PageGuard& guard, const PageGuard::Request& request) {
  return guard.whyNotLook(request).empty();
}

bool mayCommand(const PageGuard& guard, const PageGuard::Request& request) {
  return guard.whyNotCommand(request).empty();
}

TEST(PageGuard, ServesThisMachineUnderItsTwoNames) {
  const PageGuard guard("127.0.0.1", 8048, "");
  for (const std::string host : {"127.0.0.1:8048", "localhost:8048"}) {
    EXPECT_TRUE(mayLook(guard, {host, "", ""}));
    EXPECT_TRUE(mayLook(guard, {host, "http://" + host, ""}));
    EXPECT_TRUE(mayCommand(guard, {host, "http://" + host, ""}));
  }
}

TEST(PageGuard, ServesNoOtherNameThatPointsHere) {
  const PageGuard guard("127.0.0.1", 8048, "");
  for (const std::string host :
       {"", "127.0.0.1", "localhost", "127.0.0.1:80", "127.0.0.1:80480", "127.0.0.1:8048.",
        "[::1]:8048", "evil.example:8048", "127.0.0.1.evil.example:8048",
        "localhost.evil.example:8048", "evil.example@127.0.0.1:8048", "127.0.0.1:8048@evil.example",
        " 127.0.0.1:8048"}) {
    EXPECT_FALSE(mayLook(guard, {host, "", ""})) << host;
    EXPECT_FALSE(mayCommand(guard, {host, "http://" + host, ""})) << host;
    EXPECT_FALSE(mayCommand(guard, {host, "http://127.0.0.1:8048", ""})) << host;
  }
}

TEST(PageGuard, ServesNoPageOfAnotherOrigin) {
  const PageGuard guard("127.0.0.1", 8048, "");
  for (const std::string origin :
       {"null", "http://evil.example", "http://127.0.0.1", "http://127.0.0.1:8049",
        "https://127.0.0.1:8048", "http://127.0.0.1:8048/", "http://127.0.0.1:8048.evil.example",
        "http://localhost:8048", "HTTP://127.0.0.1:8048", "127.0.0.1:8048"}) {
    EXPECT_FALSE(mayLook(guard, {"127.0.0.1:8048", origin, ""})) << origin;
    EXPECT_FALSE(mayCommand(guard, {"127.0.0.1:8048", origin, ""})) << origin;
  }
}

TEST(PageGuard, TakesNoCommandThatNamesNoOrigin) {
  EXPECT_FALSE(mayCommand(PageGuard("127.0.0.1", 8048, ""), {"127.0.0.1:8048", "", ""}));
  EXPECT_FALSE(mayCommand(PageGuard("10.0.0.7", 8048, kToken), {"10.0.0.7:8048", "", kToken}));
}

TEST(PageGuard, AsksForTheWholeTokenAndNothingMore) {
  const PageGuard guard("10.0.0.7", 8048, kToken);
  const std::string host = "10.0.0.7:8048", origin = "http://" + host;
  EXPECT_TRUE(mayLook(guard, {host, "", kToken}));
  EXPECT_TRUE(mayCommand(guard, {host, origin, kToken}));
  std::string one_letter_off = kToken;
  one_letter_off.back() = '0';
  for (const std::string& token :
       {std::string(), kToken.substr(1), kToken.substr(0, 31), kToken + "0",
        kToken + std::string(1, '\0'), kToken + kToken, std::string(32, '\0'), one_letter_off,
        std::string("0123456789ABCDEF0123456789ABCDEF"), std::string(1'000'000, '0')}) {
    EXPECT_FALSE(mayLook(guard, {host, "", token}));
    EXPECT_FALSE(mayCommand(guard, {host, origin, token}));
  }
}

TEST(PageGuard, KnowsARobotUnderAnyNameByTheTokenButNoForeignPage) {
  const PageGuard guard("0.0.0.0", 8048, kToken);
  EXPECT_TRUE(mayCommand(guard, {"robot.local:8048", "http://robot.local:8048", kToken}));
  EXPECT_FALSE(mayCommand(guard, {"robot.local:8048", "http://evil.example", kToken}));
  EXPECT_FALSE(mayLook(guard, {"robot.local:8048", "null", kToken}));
}

TEST(RandomToken, Has128BitsThatNobodyHadBefore) {
  std::set<std::string> tokens;
  for (int k = 0; k < 1000; ++k) {
    const std::string token = randomToken();
    EXPECT_EQ(token.size(), 32u);
    EXPECT_EQ(token.find_first_not_of("0123456789abcdef"), std::string::npos);
    tokens.insert(token);
  }
  EXPECT_EQ(tokens.size(), 1000u);
}

}  // namespace
}  // namespace cca::page_guard_test
