// Reads a program's command line with CLI11, but by Teren's rules: a wrong one is one sentence on standard
// error and exit code 2, "-.5" is a number, and every value is checked as a whole text.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include <CLI/CLI.hpp>

#include "teren/Result.h"

namespace teren {

/// What programs end with.
enum ExitCode : int {
  kSuccess = 0,
  kWorkFailed = 1,  ///< the command line was right, the work could not be done
  kWrongInput = 2,  ///< a wrong command line, file or parameter
};

/// Writes "PROGRAM: SENTENCE" as one line to standard error; PROGRAM is the application's name.
void complain(const CLI::App& application, std::string_view sentence);

/// The same, and returns the code, for `return fail(...)`.
ExitCode fail(const CLI::App& application, ExitCode code, std::string_view sentence);

/// Parses; returns an exit code where the program should end now (after --help: kSuccess, with the text on
/// standard output; after an error: kWrongInput, with one sentence on standard error).
///
/// Add options without a variable (application.add_option("--seed", doc)), keep the pointer and read the text
/// with `argument`: CLI11's own conversions wrap negative numbers and skip empty texts.
std::optional<ExitCode> parseCommandLine(CLI::App& application, int argumentCount,
                                         const char* const* arguments);

/// The text given for an option of one value; empty where it was not given (option.count() tells).
std::string argument(const CLI::Option& option);

/// The texts as numbers in a range, ends included; `name` is the option's, for the sentence. Whole numbers
/// are decimal digits with an optional sign; reals are what parseNumber reads.
Result<std::int64_t> wholeArgument(std::string_view name, std::string_view text, std::int64_t min,
                                   std::int64_t max);
Result<double> numberArgument(std::string_view name, std::string_view text, double min, double max);
/// 0 ... 2^64 - 1.
Result<std::uint64_t> seedArgument(std::string_view name, std::string_view text);

}  // namespace teren
