#include "apps/options/CommandLine.h"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <system_error>
#include <vector>

#include "teren/Parameter.h"
#include "teren/Quote.h"

namespace teren {
namespace {

constexpr std::size_t kSentenceBytes = 400;  // of CLI11's own words, which may hold what was typed

/// CLI11 takes "-.5" for an option named '.', but "-0.5" for a number.
std::string withZeroBeforePoint(std::string text) {
  if (text.starts_with("-.") && parseNumber(text)) text.insert(1, "0");
  return text;
}

/// CLI11 takes "-inf" for an option named 'i' and would speak of everything but the number.
bool isEndlessNumber(std::string_view text) {
  return text == "-inf" || text == "-infinity" || text == "-nan";
}

/// "--seed=" would take the next argument for its value.
bool isOptionWithoutItsValue(std::string_view text) {
  return text.size() > 3 && text.starts_with("--") && text.find('=') == text.size() - 1;
}

/// CLI11's message as a sentence like ours: one line, no full stop.
std::string sentence(const CLI::ParseError& error) {
  std::string text = shortened(error.what(), kSentenceBytes);
  while (!text.empty() && (text.back() == '.' || text.back() == ' ')) text.pop_back();
  return text;
}

template <class Integer>
std::optional<Integer> wholeText(std::string_view text) {
  const bool plus = text.starts_with('+') && !text.starts_with("+-");
  const std::string_view digits = plus ? text.substr(1) : text;
  Integer value = 0;
  const char* const end = digits.data() + digits.size();
  const auto read = std::from_chars(digits.data(), end, value);
  if (digits.empty() || read.ec != std::errc() || read.ptr != end) return std::nullopt;
  return value;
}

}  // namespace

void complain(const CLI::App& application, std::string_view sentence) {
  const std::string line = application.get_name() + ": " + std::string(sentence) + "\n";
  std::fputs(line.c_str(), stderr);
}

ExitCode fail(const CLI::App& application, ExitCode code, std::string_view sentence) {
  complain(application, sentence);
  return code;
}

std::optional<ExitCode> parseCommandLine(CLI::App& application, int argumentCount,
                                         const char* const* arguments) {
  std::vector<std::string> texts(arguments + std::min(argumentCount, 1), arguments + argumentCount);
  for (std::string& text : texts) {
    if (isOptionWithoutItsValue(text)) {
      return fail(application, kWrongInput, inQuotes(text) + " has no value after the '='");
    }
    if (isEndlessNumber(text)) {
      return fail(application, kWrongInput, inQuotes(text) + " is not a finite decimal number");
    }
    text = withZeroBeforePoint(std::move(text));
  }
  std::reverse(texts.begin(), texts.end());  // as CLI11 wants them
  try {
    application.parse(std::move(texts));
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) {
      application.exit(error);  // prints the help
      return kSuccess;
    }
    return fail(application, kWrongInput, sentence(error));
  }
  return std::nullopt;
}

std::string argument(const CLI::Option& option) {
  return option.results().empty() ? std::string() : option.results().back();
}

Result<std::int64_t> wholeArgument(std::string_view name, std::string_view text, std::int64_t min,
                                   std::int64_t max) {
  const std::optional<std::int64_t> value = wholeText<std::int64_t>(text);
  if (value && min <= *value && *value <= max) return *value;
  return Error{std::string(name) + " is " + inQuotes(text) + " but must be a whole number from " +
               std::to_string(min) + " to " + std::to_string(max)};
}

Result<double> numberArgument(std::string_view name, std::string_view text, double min, double max) {
  const Result<double> value = parseNumber(text);
  if (value && min <= value.value() && value.value() <= max) return value;
  return Error{std::string(name) + " is " + inQuotes(text) + " but must be a number from " + numberText(min) +
               " to " + numberText(max)};
}

Result<std::uint64_t> seedArgument(std::string_view name, std::string_view text) {
  const std::optional<std::uint64_t> value = wholeText<std::uint64_t>(text);
  if (value) return *value;
  return Error{std::string(name) + " is " + inQuotes(text) +
               " but must be a whole number from 0 to 18446744073709551615"};
}

}  // namespace teren
