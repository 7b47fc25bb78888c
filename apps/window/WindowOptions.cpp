#include "apps/window/WindowOptions.h"

#include <cstdint>
#include <utility>

#include "teren/Quote.h"

#include "apps/options/CommandLine.h"

namespace teren {
namespace {

constexpr std::int64_t kMinSide = 64, kMaxSide = 16384;  // [pixels]
constexpr double kMostSeconds = 1e6;

Result<QSize> readSize(const std::string& text) {
  const std::size_t times = text.find('x');
  const std::string width = text.substr(0, times);
  const std::string height = times == std::string::npos ? "" : text.substr(times + 1);
  const Result<std::int64_t> columns = wholeArgument("--size", width, kMinSide, kMaxSide);
  const Result<std::int64_t> rows = wholeArgument("--size", height, kMinSide, kMaxSide);
  if (columns && rows) return QSize(static_cast<int>(*columns), static_cast<int>(*rows));
  return Error{"--size is " + inQuotes(text) + " but must be WIDTHxHEIGHT, each from " +
               std::to_string(kMinSide) + " to " + std::to_string(kMaxSide) + " pixels"};
}

Result<std::string> readFile(const CLI::Option& option) {
  const std::string file = argument(option);
  if (option.count() > 0 && file.empty()) return Error{option.get_name() + " names no file"};
  return file;
}

}  // namespace

WindowCommandLine::WindowCommandLine(CLI::App& application, const std::string& secondsDoc)
    : size_(application.add_option("--size", "of the window in pixels [1280x720]")->type_name("WxH")),
      seconds_(application.add_option("--seconds", secondsDoc)->type_name("S")),
      screenshot_(
          application.add_option("--screenshot", "save the last frame as a PNG file")->type_name("FILE")),
      stats_(application.add_option("--stats", "save figures of the run as a JSON file")->type_name("FILE")) {
}

Result<WindowOptions> WindowCommandLine::resolve() const {
  WindowOptions options;
  if (size_->count() > 0) {
    const Result<QSize> size = readSize(argument(*size_));
    if (!size) return size.error();
    options.size = *size;
  }
  if (seconds_->count() > 0) {
    const Result<double> seconds = numberArgument("--seconds", argument(*seconds_), 0.0, kMostSeconds);
    if (!seconds) return seconds.error();
    options.seconds = *seconds;
  }
  for (const auto& [option, file] : {std::pair{screenshot_, &options.screenshot}, {stats_, &options.stats}}) {
    const Result<std::string> name = readFile(*option);
    if (!name) return name.error();
    *file = *name;
  }
  return options;
}

}  // namespace teren
