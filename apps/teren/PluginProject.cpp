#include "apps/teren/PluginProject.h"

#include <cctype>
#include <string_view>

namespace teren {
namespace {

constexpr std::string_view kGenerator =
    R"(// The generator "@ID@": one random height for each map. The engine's blending makes rolling hills of them;
// put your own heights into the row.
#include <algorithm>
#include <cmath>

#include <teren/Hash.h>
#include <teren/Plugin.h>
#include <teren/RowTask.h>

namespace {

class @CLASS@ final : public teren::Generator {
 public:
  static std::span<const teren::Parameter> parameters() noexcept {
    static constexpr teren::Parameter table[] = {
        teren::Parameter::real("deviation", 20.0, 0.0, 10000.0, "m", "Standard deviation of the heights"),
    };
    return table;
  }
  explicit @CLASS@(const teren::Values& values) : deviation_(values.real("deviation")) {}

  // The mean and deviation of every sample over all seeds, and bounds that no height may leave.
  teren::HeightRange range() const override { return {0.0, deviation_, -largest(), largest()}; }
  // RMS [m] of the finest map minus the triangles through its samples of a coarser level: flat maps lose nothing.
  double residual(int, int, double) const override { return 0.0; }

  // A pure function of the parameters and the request: random numbers come from request.seed alone, and a coarse
  // map must equal the fine one, sampled.
  std::unique_ptr<teren::GenerationTask> begin(const teren::MapRequest& request,
                                               teren::HeightView out) const override {
    const double uniform = static_cast<double>(teren::RandomSequence(request.seed).nextBits(53)) * 0x1p-52 - 1.0;
    return teren::makeRowTask(out, [out, height = static_cast<float>(largest() * uniform)](int row) {
      std::fill_n(out.row(row), out.columns(), height);
    });
  }

 private:
  double largest() const { return std::sqrt(3.0) * deviation_; }
  double deviation_;
};

}  // namespace

TEREN_GENERATOR_PLUGIN(@CLASS@, "@ID@", "0.1", "Rolling hills: one random height for each lattice point")
)";

constexpr std::string_view kFilter =
    R"(// The filter "@ID@": multiplies every height. Put your own change into the row.
#include <algorithm>
#include <cmath>

#include <teren/Plugin.h>
#include <teren/RowTask.h>

namespace {

class @CLASS@ final : public teren::Filter {
 public:
  static std::span<const teren::Parameter> parameters() noexcept {
    static constexpr teren::Parameter table[] = {
        teren::Parameter::real("factor", 0.5, 0.0, 100.0, "", "What every height is multiplied with"),
    };
    return table;
  }
  explicit @CLASS@(const teren::Values& values) : factor_(values.real("factor")) {}

  // What becomes of the range and of the residual (RMS [m] lost at a coarser level) of the maps that come in.
  teren::HeightRange range(const teren::HeightRange& before) const override {
    const auto most = [this](double height) { return factor_ * height + 1e-6 * std::abs(factor_ * height); };
    const auto least = [this](double height) { return factor_ * height - 1e-6 * std::abs(factor_ * height); };
    return {factor_ * before.mean, factor_ * before.deviation, least(before.min), most(before.max)};
  }
  double residual(double before, int) const override { return factor_ * before; }

  std::unique_ptr<teren::SlicedTask> begin(const teren::MapRequest&, teren::HeightView inOut) const override {
    return teren::makeRowTask(inOut, [inOut, factor = factor_](int row) {
      std::for_each_n(inOut.row(row), inOut.columns(),
                      [factor](float& height) { height = static_cast<float>(factor * height); });
    });
  }

 private:
  double factor_;
};

}  // namespace

TEREN_FILTER_PLUGIN(@CLASS@, "@ID@", "0.1", "Multiplies every height")
)";

constexpr std::string_view kDeformer =
    R"(// The deformer "@ID@": presses round dents into the ground. Put your own tool into `apply`.
#include <teren/DeformGrid.h>
#include <teren/Plugin.h>

namespace {

class @CLASS@Surface final : public teren::LiveSurface {
 public:
  @CLASS@Surface(const teren::DeformRegion& region, teren::ConstHeightView ground) : grid_(region, ground) {}

  // [m] What a stamp changes, or why it cannot be: whatever a number may be, it ends here.
  static teren::Result<double> reach(const teren::Stamp& stamp) {
    if (!(stamp.size > 0.0 && stamp.size <= 1000.0)) return teren::Error{"size must be above 0 and up to 1000 m"};
    if (!(stamp.depth >= -1000.0 && stamp.depth <= 1000.0)) return teren::Error{"depth must be within 1000 m"};
    return stamp.size;
  }

  teren::Result<void> apply(const teren::Stamp& stamp) override {
    const teren::Result<double> reach = @CLASS@Surface::reach(stamp);
    if (!reach) return reach.error();
    if (auto place = teren::checkPlace(grid_.region(), stamp, *reach); !place) return place;
    const double spacing = grid_.region().spacing, deepest = stamp.values.real("strength") * stamp.depth;
    const teren::SampleRectangle near = grid_.region().within(stamp.east, stamp.north, *reach);
    for (int y = near.row; y < near.row + near.rows; ++y) {
      for (int x = near.column; x < near.column + near.columns; ++x) {
        const double east = (x * spacing - stamp.east) / stamp.size, north = (y * spacing - stamp.north) / stamp.size;
        const double inside = 1.0 - (east * east + north * north);
        if (inside > 0.0) grid_.set(x, y, grid_(x, y) - deepest * (inside * inside));
      }
    }
    return {};
  }

  // All is done at once here. What settles after a stamp does so in these, in numbered steps.
  bool step(const teren::Slice&, std::uint64_t) override { return true; }
  std::uint64_t steps() const noexcept override { return 0; }
  bool atRest() const noexcept override { return true; }

  std::shared_ptr<const teren::DeformedGround> snapshot() override { return grid_.snapshot(); }
  std::size_t bytes() const noexcept override { return grid_.bytes(); }

  teren::Result<void> grow(const teren::DeformRegion& region, teren::ConstHeightView ground) override {
    grid_.grow(region, ground);
    return {};
  }

 private:
  teren::DeformGrid grid_;
};

class @CLASS@ final : public teren::Deformer {
 public:
  static std::span<const teren::Parameter> parameters() noexcept {
    static constexpr teren::Parameter table[] = {
        teren::Parameter::real("strength", 1.0, 0.0, 1.0, "", "What the depth is multiplied with"),
    };
    return table;
  }
  teren::Result<double> reach(const teren::Stamp& stamp, double) const override {
    return @CLASS@Surface::reach(stamp);
  }
  teren::Result<std::unique_ptr<teren::LiveSurface>> begin(const teren::DeformRegion& region,
                                                           teren::ConstHeightView ground) const override {
    return std::unique_ptr<teren::LiveSurface>(std::make_unique<@CLASS@Surface>(region, ground));
  }
};

}  // namespace

TEREN_DEFORMER_PLUGIN(@CLASS@, "@ID@", "0.1", "Presses round dents into the ground")
)";

constexpr std::string_view kLists = R"(cmake_minimum_required(VERSION 3.25)
project(teren-@ID@ CXX)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()
find_package(Teren REQUIRED COMPONENTS core)

teren_add_plugin(@ID@ @ID@.cpp)

# The whole contract of plugins, in seconds; without --quick it takes a minute and looks closer.
enable_testing()
add_test(NAME @ID@ COMMAND ${TEREN_PROGRAM} check --quick $<TARGET_FILE:plugin-@ID@>)
)";

constexpr std::string_view kWorld = R"({ "seed": 1,
  "layers": [ @LAYER@ ] }
)";

constexpr std::string_view kReadme = R"(# teren-@ID@

A @KIND@ plugin for Teren, made by `teren new-plugin`.

    cmake -B build -D CMAKE_PREFIX_PATH=...      # where Teren is installed
    cmake --build build && ctest --test-dir build
    export TEREN_PLUGIN_PATH=$PWD/build/plugins
    teren describe @ID@
    teren-fly --world world.json                 # F5 shows what you have built since

@ID@.cpp is all of it. What it promises is in teren/@HEADER@.h; `teren check build/plugins/teren-@ID@.so` puts it to
the test, property by property.
)";

constexpr std::string_view kDeformerReadme = R"(# teren-@ID@

A deformer plugin for Teren, made by `teren new-plugin`.

    cmake -B build -D CMAKE_PREFIX_PATH=...      # where Teren is installed
    cmake --build build && ctest --test-dir build
    export TEREN_PLUGIN_PATH=$PWD/build/plugins
    teren describe @ID@

@ID@.cpp is all of it. What it promises is in teren/Deformer.h; `teren check build/plugins/teren-@ID@.so` puts it to
the test, property by property.
)";

std::string className(const std::string& id) {
  std::string name;
  bool upper = true;
  for (const char c : id) {
    if (c == '-') {
      upper = true;
      continue;
    }
    name += upper ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
    upper = false;
  }
  return name.empty() || std::isdigit(static_cast<unsigned char>(name.front())) ? "Plugin" + name : name;
}

void replaceAll(std::string& text, std::string_view what, std::string_view with) {
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + with.size())) {
    text.replace(at, what.size(), with);
  }
}

std::string_view sourceOf(PluginKind kind) {
  switch (kind) {
    case PluginKind::generator:
      return kGenerator;
    case PluginKind::filter:
      return kFilter;
    case PluginKind::deformer:
      break;
  }
  return kDeformer;
}

}  // namespace

std::vector<ProjectFile> pluginProject(PluginKind kind, const std::string& id) {
  const bool generator = kind == PluginKind::generator, deforms = kind == PluginKind::deformer;
  const std::string layer = generator
                                ? R"({ "generator": "@ID@", "pitch": 512 })"
                                : R"({ "generator": "fault", "pitch": 512, "parameters": { "deviation": 40 },
                "filters": [ { "filter": "@ID@" } ] })";
  std::vector<ProjectFile> files = {{id + ".cpp", std::string(sourceOf(kind))},
                                    {"CMakeLists.txt", std::string(kLists)},
                                    {"README.md", std::string(deforms ? kDeformerReadme : kReadme)}};
  if (!deforms) files.push_back({"world.json", std::string(kWorld)});
  for (ProjectFile& file : files) {
    replaceAll(file.text, "@LAYER@", layer);
    replaceAll(file.text, "@KIND@", kindName(kind));
    replaceAll(file.text, "@HEADER@", generator ? "Generator" : "Filter");
    replaceAll(file.text, "@CLASS@", className(id));
    replaceAll(file.text, "@ID@", id);
  }
  return files;
}

}  // namespace teren
