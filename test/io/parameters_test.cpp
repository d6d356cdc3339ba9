// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/io/parameters.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <set>
#include <stdexcept>

namespace cca {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class ParametersFile : public ::testing::Test {
 protected:
  void SetUp() override {
    path_ = ::testing::TempDir() + "parameters_test_" +
            ::testing::UnitTest::GetInstance()->current_test_info()->name() + ".ini";
  }
  void TearDown() override { std::remove(path_.c_str()); }

  std::string errorOf(const std::string& text) {
    std::ofstream(path_) << text;
    try {
      loadParameters(path_, parameters_);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }

  std::string path_;
  Parameters parameters_;
};

TEST_F(ParametersFile, SetsWhatItNamesAndLeavesTheRest) {
  EXPECT_EQ(errorOf("[mapping]\nvertex_price = 7\n[robot]\nradius = 0.3 // wide\n"), "");
  EXPECT_DOUBLE_EQ(parameters_.mapping.vertex_price, 7.0);
  EXPECT_DOUBLE_EQ(parameters_.robot.radius, 0.3);
  EXPECT_DOUBLE_EQ(parameters_.mapping.similarity_cut, Parameters().mapping.similarity_cut);
}

TEST_F(ParametersFile, NamesFileKeyValueAndRangeOfABadValue) {
  for (const char* value : {"0", "-3", "1000000", "5.5", "nan", "five", "", "5 5"}) {
    EXPECT_THAT(errorOf(std::string("[laser]\nbeams = ") + value + "\n"),
                AllOf(HasSubstr(path_), HasSubstr("[laser] beams"), HasSubstr("in [1, 100000]")))
        << value;
  }
  EXPECT_THAT(errorOf("[laser]\nrange = inf\n"), HasSubstr("[laser] range"));
  EXPECT_THAT(errorOf("[mapping]\nstraightness = 1\n"), HasSubstr("in [0, 0.5] m"));
  EXPECT_THAT(errorOf("[exploration]\nstrategy = fastest\n"), HasSubstr("one of"));
  EXPECT_THAT(errorOf("[exploration]\npath = straight\n"), HasSubstr("one of known_space paper"));
}

TEST_F(ParametersFile, RefusesUnknownKeysAndSections) {
  EXPECT_THAT(errorOf("[mapping]\nvertex_prize = 7\n"), HasSubstr("unknown key"));
  EXPECT_THAT(errorOf("[maping]\nvertex_price = 7\n"), HasSubstr("unknown section"));
  EXPECT_THAT(errorOf("[maping]\n"), HasSubstr("unknown section"));
  EXPECT_THAT(errorOf("vertex_price = 7\n"), HasSubstr("vertex_price"));
}

TEST_F(ParametersFile, NamesTheLineThatIsNoneOfAnIniFile) {
  for (const char* line :
       {"garbage", "radius 0.3", "= 0.3", "[robot", "[robot] radius = 0.3", "\x1F\x8B", "{}"}) {
    EXPECT_THAT(errorOf(std::string("[robot]\r\n# a comment\r\n") + line + "\r\n"),
                HasSubstr(path_ + ": line 3: must be [section], key = value or a comment"))
        << line;
  }
  EXPECT_THAT(errorOf("@define WIDE 0.3\n[robot]\nradius = \\\n${WIDE}\nlast"),
              HasSubstr(path_ + ": line 5: "));
  EXPECT_THAT(errorOf(std::string("[robot]\nradius = 0.3\0 and on\n", 30)), HasSubstr("line 2: "));
}

TEST_F(ParametersFile, RefusesAKeyThatIsGivenTwice) {
  for (const char* between : {"", "[mapping]\n[robot]\n"}) {
    EXPECT_THAT(
        errorOf(std::string("[robot]\nradius = 0.3\n") + between + "radius = 0.3\n"),
        AllOf(HasSubstr(path_), HasSubstr("[robot] radius: is given twice, first in line 2")));
  }
}

TEST_F(ParametersFile, PassesOverCommentsAndEmptyLines) {
  EXPECT_EQ(errorOf(""), "");
  EXPECT_EQ(errorOf("\n  \n"), "");
  EXPECT_EQ(dumpParameters(parameters_), dumpParameters(Parameters()));
  EXPECT_EQ(errorOf("\xEF\xBB\xBF; one\n// radius = 9\n [ robot ] # two\n  radius=0.3\n\n"), "");
  EXPECT_DOUBLE_EQ(parameters_.robot.radius, 0.3);
  EXPECT_EQ(errorOf("[robot]\rradius = \\\r0.4\r"), "");
  EXPECT_DOUBLE_EQ(parameters_.robot.radius, 0.4);
}

TEST_F(ParametersFile, StaysUnchangedAfterAnError) {
  EXPECT_NE(errorOf("[mapping]\nvertex_price = 7\nsimilarity_cut = 2\n"), "");
  EXPECT_EQ(parameters_.mapping.vertex_price, Parameters().mapping.vertex_price);
}

TEST_F(ParametersFile, NamesAFileThatDoesNotExistAndAFolder) {
  for (const std::string& path : {std::string("/no/such/file.ini"), ::testing::TempDir()}) {
    try {
      loadParameters(path, parameters_);
      ADD_FAILURE() << path;
    } catch (const std::runtime_error& error) {
      EXPECT_EQ(error.what(), path + ": cannot be read");
    }
  }
}

TEST_F(ParametersFile, ReadsBackWhatIsDumped) {
  Parameters written;
  written.mapping.similarity_cut = 0.123456789012345;
  written.laser.beams = 181;
  EXPECT_EQ(errorOf(dumpParameters(written)), "");
  EXPECT_EQ(parameters_.mapping.similarity_cut, written.mapping.similarity_cut);
  EXPECT_EQ(parameters_.laser.beams, 181);
  EXPECT_EQ(dumpParameters(parameters_), dumpParameters(written));
}

TEST(Parameters, DefaultsLieWithinTheirOwnRangesAndKeysAreUnique) {
  Parameters p;
  std::set<std::string> keys;
  for (const auto& field : listParameters(p)) {
    EXPECT_NO_THROW(field.set(field.get())) << field.key();
    EXPECT_TRUE(keys.insert(field.key()).second) << field.key();
    EXPECT_FALSE(field.meaning.empty()) << field.key();
  }
}

TEST(Parameters, AnIniFileThatCannotBeReadIsNamedWithItsLine) {
  const std::string path = testing::TempDir() + "broken.ini";
  std::ofstream(path) << "[mapping]\nvertex_price = $env{HOME\n";
  Parameters p;
  try {
    loadParameters(path, p);
    FAIL() << "no error";
  } catch (const std::runtime_error& error) {
    EXPECT_EQ(std::string(error.what()).rfind(path + ": ", 0), 0u) << error.what();
    EXPECT_NE(std::string(error.what()).find("Line 2"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace cca
