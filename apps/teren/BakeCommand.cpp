// teren bake WORLD --patches I J COLUMNS ROWS [--level L] ... -o FILE: a piece of landscape as a file.
#include <array>
#include <chrono>
#include <iostream>
#include <optional>

#include "teren/Bake.h"
#include "teren/HeightMapOperations.h"
#include "teren/Parameter.h"
#include "teren/Quote.h"

#include "apps/files/OutputFile.h"
#include "apps/options/EditOptions.h"
#include "apps/options/WorldOptions.h"
#include "apps/teren/Command.h"
#include "apps/teren/EditedWorld.h"
#include "apps/teren/HeightFile.h"
#include "apps/teren/Interruption.h"
#include "apps/teren/JsonOutput.h"
#include "apps/teren/ProgressLine.h"

namespace teren {
namespace {

constexpr std::int64_t kLongestSlice = 1'000'000'000;  // [us]
constexpr std::int64_t kHighestLevel = 60;

/// What was asked for, checked as far as the command line alone tells.
struct Order {
  BakeRegion region;
  std::chrono::microseconds slice{0};
  int workers = 0;
  std::filesystem::path file;
  HeightFormat format = HeightFormat::r32;
};

/// The value of an option that may be absent.
Result<std::int64_t> wholeOption(const CLI::Option& option, std::int64_t absent, std::int64_t min,
                                 std::int64_t max) {
  if (option.count() == 0) return absent;
  return wholeArgument(option.get_name(), argument(option), min, max);
}

class BakeCommand final : public Command {
 public:
  explicit BakeCommand(CLI::App& parent)
      : Command(parent, "bake", "write a piece of the landscape to a file"),
        world_(application()),
        edits_(application(), "[none]"),
        patches_(application()
                     .add_option("--patches", "the piece: its south-west patch, and how many east and north")
                     ->type_name("I J COLUMNS ROWS")
                     ->expected(4)
                     ->required()),
        level_(application()
                   .add_option("--level", "0 is finest; each level halves the samples [0]")
                   ->type_name("L")),
        workers_(
            application()
                .add_option("--workers", "threads that make the landscape; 0: none but the program's own [0]")
                ->type_name("N")),
        slice_(application()
                   .add_option("--slice-us", "microseconds a slice of work may take, 0: unlimited [0]")
                   ->type_name("N")),
        output_(application()
                    .add_option("-o", "what to write, .r32, .png, .obj or .iv")
                    ->type_name("FILE")
                    ->required()),
        json_(addJson()) {}

  ExitCode run() override {
    const Result<Order> order = readOrder();
    if (!order) return fail(kWrongInput, order.error().message);
    const std::shared_ptr<const PluginRegistry> registry = PluginRegistry::standard();
    const Result<std::shared_ptr<const World>> world = world_.create(*registry);
    if (!world) return fail(kWrongInput, world.error().message);
    return carryOut(*order, *world, registry);
  }

 private:
  Result<Order> readOrder() const {
    Order order;
    std::array<std::int64_t, 4> numbers{};
    const std::array<const char*, 4> names = {"I of --patches", "J of --patches", "COLUMNS of --patches",
                                              "ROWS of --patches"};
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      const std::int64_t least = k < 2 ? -kMaxPatch : 1;
      const Result<std::int64_t> number =
          wholeArgument(names[k], patches_->results().at(k), least, kMaxPatch);
      if (!number) return number.error();
      numbers[k] = number.value();
    }
    const Result<std::int64_t> level = wholeOption(*level_, 0, 0, kHighestLevel);
    if (!level) return level.error();
    const Result<std::int64_t> slice = wholeOption(*slice_, 0, 0, kLongestSlice);
    if (!slice) return slice.error();
    const Result<std::int64_t> workers = wholeOption(*workers_, 0, 0, BakeOptions::kMostWorkers);
    if (!workers) return workers.error();
    order.region = {numbers[0], numbers[1], numbers[2], numbers[3], static_cast<int>(level.value())};
    order.slice = std::chrono::microseconds(slice.value());
    order.workers = static_cast<int>(workers.value());
    order.file = argument(*output_);
    const Result<HeightFormat> format = heightFormat(order.file);
    if (!format) return format.error();
    order.format = format.value();
    return order;
  }

  ExitCode carryOut(const Order& order, const std::shared_ptr<const World>& shared,
                    const std::shared_ptr<const PluginRegistry>& registry) {
    const World& world = *shared;
    const Interruption interruption;
    Result<OutputFile> file = OutputFile::create(order.file);
    if (!file) return fail(kWorkFailed, file.error().message);
    const std::string consequence = inQuotes(order.file.string()) + " was not written";
    const std::string unfinished = "interrupted, " + consequence;
    const auto edited = groundOfOptions(edits_, shared, registry, interruption);
    if (interruption.came()) return fail(kWorkFailed, unfinished);
    if (const auto code = failWith(world, consequence)) return *code;
    if (!edited) return fail(kWrongInput, edited.error().message);

    const auto start = std::chrono::steady_clock::now();
    Result<HeightMap> heights = bakeShowingProgress(order, world, edited->get(), interruption);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    if (interruption.came()) return fail(kWorkFailed, unfinished);
    if (const auto code = failWith(world, consequence)) return *code;
    if (!heights) return fail(kWrongInput, heights.error().message);

    Result<void> written = writeShowingProgress(order, world, heights->view(), file->stream(), interruption);
    if (interruption.came()) return fail(kWorkFailed, unfinished);
    if (!written) {
      return fail(kWorkFailed,
                  "cannot write " + inQuotes(order.file.string()) + ": " + written.error().message);
    }
    written = file->commit();
    if (!written) return fail(kWorkFailed, written.error().message);
    complainAbout(world);
    answer(order, heights->view(), seconds.count());
    return kSuccess;
  }

  static Result<HeightMap> bakeShowingProgress(const Order& order, const World& world,
                                               const EditedGround* edits, const Interruption& interruption) {
    ProgressLine line("nodes");
    BakeOptions options;
    options.slice = order.slice;
    options.workers = order.workers;
    options.edits = edits;
    options.progress = [&](std::size_t done, std::size_t wanted) {
      line.show(done, wanted);
      return !interruption.came() && !world.failure();
    };
    return bake(world, order.region, options);
  }

  static Result<void> writeShowingProgress(const Order& order, const World& world, ConstHeightView heights,
                                           std::FILE* stream, const Interruption& interruption) {
    ProgressLine line("rows written");
    const GroundPlace place{order.region.i, order.region.j, world.pitch(), world.spacing(order.region.level)};
    return writeHeights(heights, order.format, place, stream, [&](std::size_t done, std::size_t wanted) {
      line.show(done, wanted);
      return !interruption.came();
    });
  }

  void answer(const Order& order, ConstHeightView heights, double seconds) const {
    const HeightStatistics figures = statistics(heights);
    const std::string hash = hashDigits(heightHash(heights));
    if (json_->count() > 0) {
      printJson({{"samples", {heights.columns(), heights.rows()}},
                 {"min", figures.min},
                 {"max", figures.max},
                 {"mean", figures.mean},
                 {"std", figures.deviation},
                 {"hash", hash},
                 {"seconds", seconds}});
      return;
    }
    std::cout << order.file.string() << ": " << heights.columns() << " x " << heights.rows()
              << " heights from " << numberText(figures.min) << " to " << numberText(figures.max)
              << " m, mean " << numberText(figures.mean) << " m, standard deviation "
              << numberText(figures.deviation) << " m, hash " << hash << ", " << numberText(seconds)
              << " s\n";
  }

  WorldOptions world_;
  EditOptions edits_;
  const CLI::Option* patches_;
  const CLI::Option* level_;
  const CLI::Option* workers_;
  const CLI::Option* slice_;
  const CLI::Option* output_;
  const CLI::Option* json_;
};

}  // namespace

std::unique_ptr<Command> makeBakeCommand(CLI::App& parent) {
  return std::make_unique<BakeCommand>(parent);
}

}  // namespace teren
