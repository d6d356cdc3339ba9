// SPDX-License-Identifier: BSD-3-Clause
#include "apps/program.hpp"

#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>

namespace cca::apps {
namespace {

constexpr int kDone = 0, kRunFailed = 1, kUsage = 2, kFellShort = 3;
const std::string kStatuses =
    "Exit status: 0 done; 1 failed, or interrupted (what was mapped so far is saved);\n"
    "2 no such command or option, or a value that is not allowed; 3 done, but the result\n"
    "falls short, as the last message says (contacts, scans that contradict the map, ...).";

/// MRPT's own errors are pages with a call stack; the cause stands behind "Message:".
std::string withoutCallStack(const std::string& error) {
  const std::string key = "Message:";
  const std::size_t found = error.find(key);
  if (error.rfind("==== MRPT", 0) != 0 || found == std::string::npos) return error;
  const std::size_t begin = error.find_first_not_of(' ', found + key.size());
  return error.substr(begin, error.find('\n', begin) - begin);
}

bool isCommand(const CLI::App& program, const std::string& name) {
  return !program.get_subcommands([&](const CLI::App* c) { return c->get_name() == name; }).empty();
}

void tell(const CLI::App& program, const std::string& message) {
  std::fprintf(stderr, "%s: %s\n", program.get_name().c_str(), message.c_str());
}

/// An empty value is a shell variable that was never set; a value that is an option of the command
/// was forgotten.
void refuseForgottenValues(CLI::App& program) {
  for (CLI::App* command : program.get_subcommands({})) {
    for (CLI::Option* option : command->get_options()) {
      if (option->get_expected_min() == 0) continue;
      option->check([command](const std::string& value) -> std::string {
        if (value.empty()) return "is empty";
        const bool is_option = value.rfind("--", 0) == 0 && command->get_option_no_throw(value);
        return is_option ? "its value is missing before " + value : "";
      });
    }
  }
}

/// What is missing is asked for before what is too much is told of: a misspelt --out is both.
void tellOfUnknownOptions(const CLI::App& program) {
  for (const std::string& word : program.remaining(true)) {
    if (word.rfind('-', 0) != 0) continue;
    std::fprintf(stderr, "The following argument was not expected: %s\n", word.c_str());
  }
}

/// What was printed may not have arrived: a full disk behind `> FILE` is told at the end only.
int withOutput(const CLI::App& program, int status) {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return status;
  tell(program, "standard output: cannot be written");
  return status == kDone ? kRunFailed : status;
}

}  // namespace

int runProgram(CLI::App& program, int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN);  // a limit of file sizes is an error to tell of, as a full disk is
  const std::string name = program.get_name();
  program.require_subcommand(1);
  program.set_version_flag("--version", name + " " CCA_VERSION);
  program.footer(kStatuses);
  if (argc > 1 && argv[1][0] != '-' && !isCommand(program, argv[1])) {
    std::fprintf(stderr, "%s is no command of %s; see %s --help\n", argv[1], name.c_str(),
                 name.c_str());
    return kUsage;
  }
  refuseForgottenValues(program);
  try {
    program.parse(argc, argv);
  } catch (const CLI::RequiredError& error) {
    tellOfUnknownOptions(program);
    program.exit(error);
    return kUsage;
  } catch (const CLI::ParseError& error) {
    return withOutput(program, program.exit(error) == 0 ? kDone : kUsage);
  } catch (const Shortcoming& shortcoming) {
    tell(program, shortcoming.what());
    return withOutput(program, kFellShort);
  } catch (const std::filesystem::filesystem_error& error) {
    tell(program, error.path1().string() + ": " + error.code().message());
    return kRunFailed;
  } catch (const std::exception& error) {
    tell(program, withoutCallStack(error.what()));
    return kRunFailed;
  }
  return withOutput(program, kDone);
}

}  // namespace cca::apps
