#include "apps/fly/FlyOptions.h"

#include "teren/Quote.h"

#include "apps/fly/Aircraft.h"
#include "apps/options/CommandLine.h"

namespace teren {
namespace {

constexpr std::int64_t kMinSide = 64, kMaxSide = 16384;  // [pixels]
constexpr int kMaxRadius = 64;                           // ViewSettings
constexpr double kLongestFlight = 1e6;                   // [s]

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

Result<double> readNumber(const CLI::Option& option, double otherwise, double min, double max) {
  if (option.count() == 0) return otherwise;
  return numberArgument(option.get_name(), argument(option), min, max);
}

Result<int> readWhole(const CLI::Option& option, int otherwise, int min, int max) {
  if (option.count() == 0) return otherwise;
  const Result<std::int64_t> value = wholeArgument(option.get_name(), argument(option), min, max);
  if (!value) return value.error();
  return static_cast<int>(*value);
}

Result<std::string> readFile(const CLI::Option& option) {
  const std::string file = argument(option);
  if (option.count() > 0 && file.empty()) return Error{option.get_name() + " names no file"};
  return file;
}

}  // namespace

FlyCommandLine::FlyCommandLine(CLI::App& application)
    : viewDistance_(addViewDistance(
          application, "metres of land to draw in every direction at least; sets --radius [2560]")),
      viewLevel_(
          application.add_option("--view-level", "level of the land, 0 is finest [3]")->type_name("L")),
      radius_(application.add_option("--radius", "nodes to draw in every direction, 1 to 64 [5]")
                  ->type_name("R")),
      speed_(application.add_option("--speed", "at the start, metres per second, 5 to 600 [60]")
                 ->type_name("V")),
      size_(application.add_option("--size", "of the window in pixels [1280x720]")->type_name("WxH")),
      seconds_(application.add_option("--seconds", "fly this long, then end")->type_name("S")),
      screenshot_(
          application.add_option("--screenshot", "save the last frame as a PNG file")->type_name("FILE")),
      stats_(
          application.add_option("--stats", "save figures of the flight as a JSON file")->type_name("FILE")) {
}

Result<ViewSettings> FlyCommandLine::view(const World& world) const {
  ViewSettings view = FlyOptions{}.view;
  const Result<int> level =
      readWhole(*viewLevel_, std::min(view.level, world.topLevel()), 0, world.topLevel());
  if (!level) return level.error();
  view.level = *level;
  const Result<int> radius = readWhole(*radius_, view.radius, 1, kMaxRadius);
  if (!radius) return radius.error();
  view.radius = *radius;
  if (viewDistance_->count() > 0 && radius_->count() > 0) {
    return Error{"--view-distance and --radius exclude each other"};
  }
  return viewReaching(*viewDistance_, view, world);
}

Result<FlyOptions> FlyCommandLine::resolve(const World& world) const {
  FlyOptions options;
  const Result<ViewSettings> view = this->view(world);
  if (!view) return view.error();
  options.view = *view;
  const Result<double> speed = readNumber(*speed_, options.speed, Aircraft::kMinSpeed, Aircraft::kMaxSpeed);
  if (!speed) return speed.error();
  options.speed = *speed;
  if (size_->count() > 0) {
    const Result<QSize> size = readSize(argument(*size_));
    if (!size) return size.error();
    options.size = *size;
  }
  const Result<double> seconds = readNumber(*seconds_, 0.0, 0.0, kLongestFlight);
  if (!seconds) return seconds.error();
  if (seconds_->count() > 0) options.seconds = *seconds;
  for (const auto& [option, file] : {std::pair{screenshot_, &options.screenshot}, {stats_, &options.stats}}) {
    const Result<std::string> name = readFile(*option);
    if (!name) return name.error();
    *file = *name;
  }
  return options;
}

}  // namespace teren
