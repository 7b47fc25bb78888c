#include "apps/sandbox/SandFile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "generators/sand/SandArchive.h"
#include "tests/engine/plugin/ScratchFolder.h"
#include "tests/generators/sand/Heaps.h"

namespace teren {
namespace {

Sandbox heap(int vertices) {
  Sandbox sandbox(scatteredSand(vertices, 91, 5.0, cone), {});
  sandbox.loosenAll();
  sandbox.slide(500);
  (void)sandbox.stamp(*ToolShape::disc(0.05, 0.1), {0.3, 0.4, 0.0});
  return sandbox;
}

std::vector<std::string> filesIn(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    names.push_back(entry.path().filename());
  return names;
}

void write(const std::string& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
}

/// While one lives, no file of this process may grow beyond so many bytes.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) {
    getrlimit(RLIMIT_FSIZE, &former_);
    const rlimit limit = {bytes, former_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
    formerAction_ = std::signal(SIGXFSZ, SIG_IGN);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;
  ~FullDisk() {
    setrlimit(RLIMIT_FSIZE, &former_);
    std::signal(SIGXFSZ, formerAction_);
  }

 private:
  rlimit former_{};
  void (*formerAction_)(int) = SIG_DFL;
};

/// One line that names the file and is short enough to read.
template <class Value>
void expectOneSentence(const Result<Value>& result, const std::string& named) {
  ASSERT_FALSE(result) << named;
  const std::string& text = result.error().message;
  EXPECT_TRUE(text.size() < 400 && text.find('\n') == std::string::npos && text.back() != '.') << text;
  EXPECT_NE(text.find(named), std::string::npos) << text;
}

TEST(SandFile, LoadsWhatWasSavedAndReplacesOlderFiles) {
  const ScratchFolder folder;
  const std::string file = folder / "castle.sand";
  for (const int vertices : {500, 100}) {
    const Sandbox sandbox = heap(vertices);
    const Result<void> saved = saveSand(file, sandbox);
    ASSERT_TRUE(saved) << saved.error().message;
    const Result<Sandbox> loaded = loadSand(file);
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(archived(*loaded), archived(sandbox));
    EXPECT_EQ(std::filesystem::file_size(file), archived(sandbox).size());
  }
  EXPECT_EQ(filesIn(folder.path()), std::vector<std::string>{"castle.sand"});
}

/// An .obj file, as a reader of such files understands it.
struct Obj {
  std::vector<std::array<double, 3>> places, normals;
  std::vector<std::array<std::size_t, 3>> faces;
  explicit Obj(const std::string& file) {
    std::ifstream stream(file);
    for (std::string line; std::getline(stream, line);) {
      std::istringstream words(line);
      std::string kind;
      words >> kind;
      if (kind == "v" || kind == "vn") {
        std::array<double, 3>& numbers = (kind == "v" ? places : normals).emplace_back();
        words >> numbers[0] >> numbers[1] >> numbers[2];
      } else if (kind == "f") {
        for (std::size_t& corner : faces.emplace_back()) {
          std::string text;
          words >> text;
          std::size_t end = 0;
          corner = std::stoul(text, &end) - 1;
          EXPECT_EQ(text.substr(end), "//" + text.substr(0, end));
        }
      } else {
        EXPECT_TRUE(kind == "#" || kind == "o") << line;
      }
      EXPECT_FALSE(words.fail()) << line;
    }
  }
};

TEST(SandFile, ExportsEveryVertexAndTriangleAsSeenFromAbove) {
  const ScratchFolder folder;
  const Sandbox sandbox = heap(300);
  const Result<void> exported = exportObj(folder / "heap.obj", sandbox);
  ASSERT_TRUE(exported) << exported.error().message;
  const Obj obj(folder / "heap.obj");
  const Triangulation& mesh = sandbox.surface().mesh();
  ASSERT_LT(mesh.vertexCount(), mesh.vertexSlots()) << "free slots are no vertices";
  ASSERT_EQ(obj.places.size(), mesh.vertexCount());
  ASSERT_EQ(obj.normals.size(), mesh.vertexCount());
  ASSERT_EQ(obj.faces.size(), mesh.triangleCount());
  std::size_t n = 0;
  for (VertexId v = 0; v < mesh.vertexSlots(); ++v) {
    if (!mesh.isVertex(v)) continue;
    const std::array<double, 3> place{mesh.frame().placeX(mesh.point(v)), mesh.frame().placeY(mesh.point(v)),
                                      mesh.height(v)};
    ASSERT_EQ(obj.places[n++], place) << "the same doubles";
  }
  double area = 0.0, volume = 0.0;
  for (const auto& face : obj.faces) {
    const auto &a = obj.places[face[0]], &b = obj.places[face[1]], &c = obj.places[face[2]];
    const double twice = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    ASSERT_GT(twice, 0.0);
    area += twice / 2.0;
    volume += twice / 6.0 * (a[2] + b[2] + c[2]);
  }
  EXPECT_NEAR(area, 1.0, 1e-9);
  const double step = sandbox.surface().step();
  EXPECT_NEAR(volume, asDouble(sandbox.surface().volume()) * kMetresPerTick * step * step / 6.0, 1e-9);
  for (const auto& normal : obj.normals) {
    EXPECT_GT(normal[2], 0.0);
    EXPECT_NEAR(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2], 1.0, 3e-4);
  }
}

TEST(SandFile, ExportsTheNormalOfASlope) {
  const ScratchFolder folder;
  const Sandbox sandbox(scatteredSand(100, 92, 0.0, [](double x, double) { return 0.75 * x; }), {});
  ASSERT_TRUE(exportObj(folder / "slope.obj", sandbox));
  for (const auto& normal : Obj(folder / "slope.obj").normals) {
    EXPECT_NEAR(normal[0], -0.6, 1e-4);
    EXPECT_NEAR(normal[1], 0.0, 1e-4);
    EXPECT_NEAR(normal[2], 0.8, 1e-4);
  }
}

TEST(SandFile, ThatCannotBeWrittenLeavesTheOldOneAndNoHalfOne) {
  const Sandbox sandbox = heap(500);
  for (const auto& keep : {saveSand, exportObj}) {
    const ScratchFolder folder;
    const std::string old = folder / "old";
    write(old, "what was there");
    {
      const FullDisk full(10'000);
      expectOneSentence(keep(old, sandbox), "old");
    }
    EXPECT_EQ(fileBytes(old), "what was there");
    std::filesystem::create_directory(folder / "folder");
    expectOneSentence(keep(folder / "folder", sandbox), "folder");
    expectOneSentence(keep(folder / "none" / "file", sandbox), "none");
    expectOneSentence(keep("", sandbox), "\"\"");
    expectOneSentence(keep(old + std::string(1, '\0') + "tail", sandbox), "tail");
    expectOneSentence(keep(folder / std::string(5'000, 'n'), sandbox), "...");
    expectOneSentence(keep("/dev/full", sandbox), "/dev/full");
    ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
    expectOneSentence(keep(folder / "pipe", sandbox), "pipe");
    std::vector<std::string> left = filesIn(folder.path());
    std::sort(left.begin(), left.end());
    EXPECT_EQ(left, (std::vector<std::string>{"folder", "old", "pipe"}));
    EXPECT_EQ(fileBytes(old), "what was there");
  }
}

TEST(SandFile, ThatIsNoSavedSandIsRefused) {
  const ScratchFolder folder;
  const std::string file = folder / "bad";
  ASSERT_TRUE(saveSand(file, heap(200)));
  const std::string good = fileBytes(file);
  for (const std::size_t size :
       {std::size_t{0}, std::size_t{7}, std::size_t{100}, good.size() / 2, good.size() - 1}) {
    write(file, good.substr(0, size));
    expectOneSentence(loadSand(file), "bad");
  }
  write(file, good + "x");
  expectOneSentence(loadSand(file), "bad");
  write(file, "v 0 0 0\n");
  expectOneSentence(loadSand(file), "bad");
  std::filesystem::resize_file(file, std::uintmax_t{1} << 40);  // a hole of a terabyte
  expectOneSentence(loadSand(file), "larger");
  write(file, good);
  std::filesystem::resize_file(file, std::uintmax_t{1} << 22);  // sand, then zeros
  expectOneSentence(loadSand(file), "bad");
}

TEST(SandFile, ThatIsNoFileIsRefused) {
  const ScratchFolder folder;
  ASSERT_TRUE(saveSand(folder / "good", heap(100)));
  std::filesystem::create_symlink(folder / "circle", folder / "circle");
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  expectOneSentence(loadSand(folder / "none"), "none");
  expectOneSentence(loadSand(folder.path()), folder.path().filename());
  expectOneSentence(loadSand(folder / "circle"), "circle");
  expectOneSentence(loadSand(folder / "pipe"), "pipe");
  expectOneSentence(loadSand("/dev/zero"), "/dev/zero");
  expectOneSentence(loadSand(""), "\"\"");
  expectOneSentence(loadSand((folder / "good").string() + std::string(1, '\0') + "tail"), "tail");
}

}  // namespace
}  // namespace teren
