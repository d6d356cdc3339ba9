// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include <iostream>

namespace {

// The tests that stand in NAME.cpp, as a filter of GoogleTest's; empty where there are none.
std::string testsOf(const std::string& name) {
  std::string filter;
  const testing::UnitTest& all = *testing::UnitTest::GetInstance();
  for (int i = 0; i < all.total_test_suite_count(); ++i) {
    const testing::TestSuite& suite = *all.GetTestSuite(i);
    for (int j = 0; j < suite.total_test_count(); ++j) {
      const testing::TestInfo& test = *suite.GetTestInfo(j);
      const std::string file = test.file();
      if (file.substr(file.rfind('/') + 1) != name + ".cpp") continue;
      filter += std::string(suite.name()) + '.' + test.name() + ':';
    }
  }
  return filter;
}

}  // namespace

// A folder's tests in one program: PROGRAM [GoogleTest's options] [NAME] runs those of NAME.cpp, or
// all.
int main(int argc, char** argv) {
  testing::InitGoogleMock(&argc, argv);
  if (argc > 1) {
    const std::string filter = testsOf(argv[1]);
    if (filter.empty()) {
      std::cerr << "no tests of " << argv[1] << ".cpp\n";
      return 1;
    }
    testing::GTEST_FLAG(filter) = filter;
  }
  return RUN_ALL_TESTS();
}
