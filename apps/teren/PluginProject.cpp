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

}  // namespace

std::vector<ProjectFile> pluginProject(PluginKind kind, const std::string& id) {
  const bool generator = kind == PluginKind::generator;
  const std::string layer = generator
                                ? R"({ "generator": "@ID@", "pitch": 512 })"
                                : R"({ "generator": "fault", "pitch": 512, "parameters": { "deviation": 40 },
                "filters": [ { "filter": "@ID@" } ] })";
  std::vector<ProjectFile> files = {{id + ".cpp", std::string(generator ? kGenerator : kFilter)},
                                    {"CMakeLists.txt", std::string(kLists)},
                                    {"world.json", std::string(kWorld)},
                                    {"README.md", std::string(kReadme)}};
  for (ProjectFile& file : files) {
    replaceAll(file.text, "@LAYER@", layer);
    replaceAll(file.text, "@KIND@", generator ? "generator" : "filter");
    replaceAll(file.text, "@HEADER@", generator ? "Generator" : "Filter");
    replaceAll(file.text, "@CLASS@", className(id));
    replaceAll(file.text, "@ID@", id);
  }
  return files;
}

}  // namespace teren
