// What `teren bake` writes, and what it leaves behind when it cannot.
#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <csetjmp>
#include <cstdio>
#include <png.h>
#include <set>
#include <sys/stat.h>
#include <thread>
#include <utility>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "teren/Hash.h"

#include "tests/apps/teren/BakedFiles.h"
#include "tests/apps/teren/Program.h"

namespace teren {
namespace {

using Json = nlohmann::json;

/// A 16-bit grey picture, north row first.
struct Picture {
  std::size_t columns = 0, rows = 0;
  std::vector<std::uint16_t> greys;
};

Picture readPng(const std::filesystem::path& file) {
  Picture picture;
  std::FILE* stream = std::fopen(file.c_str(), "rb");
  if (stream == nullptr) return picture;
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  if (setjmp(png_jmpbuf(png)) == 0) {
    png_init_io(png, stream);
    png_read_png(png, info, PNG_TRANSFORM_IDENTITY, nullptr);
    EXPECT_EQ(png_get_bit_depth(png, info), 16);
    EXPECT_EQ(png_get_color_type(png, info), PNG_COLOR_TYPE_GRAY);
    picture.columns = png_get_image_width(png, info);
    picture.rows = png_get_image_height(png, info);
    png_bytepp rows = png_get_rows(png, info);
    for (std::size_t k = 0; k < picture.columns * picture.rows; ++k) {
      const png_bytep sample = rows[k / picture.columns] + 2 * (k % picture.columns);
      picture.greys.push_back(static_cast<std::uint16_t>(sample[0] * 256 + sample[1]));
    }
  } else {
    ADD_FAILURE() << "not a picture";
  }
  png_destroy_read_struct(&png, &info, nullptr);
  std::fclose(stream);
  return picture;
}

TEST(Bake, AnswersWithTheFiguresOfItsFile) {
  const ScratchFolder folder;
  const Json answer = bakeJson(folder / "a.r32");
  std::set<std::string> keys;
  for (const auto& item : answer.items()) keys.insert(item.key());
  EXPECT_EQ(keys, (std::set<std::string>{"samples", "min", "max", "mean", "std", "hash", "seconds"}));
  EXPECT_EQ(answer.at("samples"), Json::parse("[97, 65]"));

  const std::vector<float> heights = readR32(folder / "a.r32");
  ASSERT_EQ(heights.size(), 97U * 65U);
  EXPECT_EQ(answer.at("min").get<float>(), *std::min_element(heights.begin(), heights.end()));
  EXPECT_EQ(answer.at("max").get<float>(), *std::max_element(heights.begin(), heights.end()));
  double sum = 0.0;
  for (const float height : heights) sum += height;
  const double mean = sum / static_cast<double>(heights.size());
  double squares = 0.0;
  for (const float height : heights) squares += (height - mean) * (height - mean);
  EXPECT_NEAR(answer.at("mean").get<double>(), mean, 1e-9);
  EXPECT_NEAR(answer.at("std").get<double>(), std::sqrt(squares / static_cast<double>(heights.size())), 1e-9);
  EXPECT_GT(answer.at("std").get<double>(), 0.1);
}

TEST(Bake, HashesTheBytesOfItsFile) {
  const ScratchFolder folder;
  const Json answer = bakeJson(folder / "a.r32");
  Fnv1a hash;
  for (const char byte : fileBytes(folder / "a.r32")) hash.addByte(static_cast<std::uint8_t>(byte));
  char digits[17] = {};
  std::snprintf(digits, sizeof(digits), "%016llx", static_cast<unsigned long long>(hash.value()));
  EXPECT_EQ(answer.at("hash"), digits);
}

TEST(Bake, GivesTheSameHashWhateverTheFormatTheSlicesAndTheWorkers) {
  const ScratchFolder folder;
  const Json first = bakeJson(folder / "a.r32");
  for (const Json& other :
       {bakeJson(folder / "a.png"), bakeJson(folder / "a.obj"), bakeJson(folder / "a.iv"),
        bakeJson(folder / "b.r32", {"--slice-us", "1"}), bakeJson(folder / "c.r32", {"--workers", "0"}),
        bakeJson(folder / "d.r32", {"--workers", "1"}), bakeJson(folder / "e.r32", {"--workers", "3"}),
        bakeJson(folder / "f.r32", {"--workers", "64"})}) {
    EXPECT_EQ(other.at("hash"), first.at("hash"));
  }
  for (const char* name : {"b.r32", "d.r32", "e.r32", "f.r32"}) {
    EXPECT_EQ(fileBytes(folder / "a.r32"), fileBytes(folder / name)) << name;
  }
}

TEST(Bake, WritesThePictureNorthUpFromLowestToHighest) {
  const ScratchFolder folder;
  const Json answer = bakeJson(folder / "a.r32");
  bakeJson(folder / "a.png");
  const std::vector<float> heights = readR32(folder / "a.r32");
  const Picture picture = readPng(folder / "a.png");
  ASSERT_EQ(picture.columns, 97U);
  ASSERT_EQ(picture.rows, 65U);
  const double low = answer.at("min").get<double>();
  const double high = answer.at("max").get<double>();
  for (std::size_t row = 0; row < picture.rows; ++row) {
    for (std::size_t column = 0; column < picture.columns; ++column) {
      const double height = heights[(picture.rows - 1 - row) * picture.columns + column];
      const double grey = std::round((height - low) / (high - low) * 65535.0);
      ASSERT_NEAR(picture.greys[row * picture.columns + column], grey, 1.0) << column << ", " << row;
    }
  }
  EXPECT_EQ(*std::min_element(picture.greys.begin(), picture.greys.end()), 0);
  EXPECT_EQ(*std::max_element(picture.greys.begin(), picture.greys.end()), 65535);
}

TEST(Bake, WritesFlatGroundAsBlack) {
  const ScratchFolder folder;
  const Answer answer =
      teren({"bake", "--generator", "flat", "--patches", "0", "0", "1", "1", "-o", folder / "a.png"});
  ASSERT_EQ(answer.exitCode, 0) << answer.complaint;
  for (const std::uint16_t grey : readPng(folder / "a.png").greys) ASSERT_EQ(grey, 0);
}

TEST(Bake, KnowsOnlyOneZero) {
  const ScratchFolder folder;
  const Answer answer = teren({"bake", "--generator", "flat", "--set", "height=-0", "--patches", "0", "0",
                               "1", "1", "-o", folder / "a.r32"});
  ASSERT_EQ(answer.exitCode, 0) << answer.complaint;
  for (const char byte : fileBytes(folder / "a.r32")) ASSERT_EQ(byte, 0);
}

TEST(Bake, WritesFewerSamplesAtHigherLevels) {
  const ScratchFolder folder;
  EXPECT_EQ(bakeJson(folder / "a.r32", {"--level", "1"}).at("samples"), Json::parse("[49, 33]"));
  EXPECT_EQ(std::filesystem::file_size(folder / "a.r32"), 49U * 33U * 4U);
}

TEST(Bake, ReplacesAFileAndFollowsALink) {
  const ScratchFolder folder;
  folder.write("target.r32", "old");
  std::filesystem::create_symlink("target.r32", folder / "link.r32");
  bakeJson(folder / "link.r32");
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link.r32"));
  EXPECT_EQ(readR32(folder / "target.r32").size(), 97U * 65U);
  EXPECT_EQ(namesIn(folder.path()).size(), 2U);
}

TEST(Bake, GivesItsFileOrdinaryPermissions) {
  const ScratchFolder folder;
  const mode_t mask = umask(027);
  bakeJson(folder / "a.r32");
  umask(mask);
  struct stat status {};
  ASSERT_EQ(stat((folder / "a.r32").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777U, 0640U);
}

TEST(Bake, LeavesNoHalfFileAndTheOldOneWhenTheDiskIsFull) {
  for (const std::string name : {"a.r32", "a.png", "a.obj", "a.iv"}) {
    const ScratchFolder folder;
    folder.write(name, "old");
    Program::Settings settings;
    settings.largestFile = 5000;
    const Answer answer = Program(bakeFault(folder / name), settings).finish();
    EXPECT_EQ(answer.exitCode, 1);
    EXPECT_TRUE(isOneSentence(answer.complaint)) << answer.complaint;
    EXPECT_NE(answer.complaint.find(name), std::string::npos) << answer.complaint;
    EXPECT_EQ(namesIn(folder.path()), std::vector<std::string>{name});
    EXPECT_EQ(fileBytes(folder / name), "old");
  }
}

TEST(Bake, LeavesNothingWhenTheRegionIsRefused) {
  const ScratchFolder folder;
  const Answer answer = teren(bakeFault(folder / "a.r32", {"--level", "40"}));
  EXPECT_EQ(answer.exitCode, 2);
  EXPECT_TRUE(namesIn(folder.path()).empty());
}

TEST(Bake, NeverReplacesDevicesPipesOrFolders) {
  const ScratchFolder folder;
  ASSERT_EQ(mkfifo((folder / "pipe.r32").c_str(), 0600), 0);
  std::filesystem::create_directory(folder / "folder.r32");
  std::filesystem::create_symlink("/dev/null", folder / "device.r32");
  for (const std::string name : {"pipe.r32", "folder.r32", "device.r32", "absent/a.r32"}) {
    const Answer answer = teren(bakeFault(folder / name));
    EXPECT_EQ(answer.exitCode, 1) << name;
    EXPECT_TRUE(isOneSentence(answer.complaint)) << answer.complaint;
    EXPECT_NE(answer.complaint.find(name), std::string::npos) << answer.complaint;
  }
  EXPECT_EQ(namesIn(folder.path()).size(), 3U);
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

/// Waits until the program has begun its file.
bool waitForAFile(const std::filesystem::path& folder) {
  for (int tries = 0; tries < 6000; ++tries) {
    if (!namesIn(folder).empty()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

TEST(Bake, StopsCleanlyWhenInterrupted) {
  for (const auto& [signal, workers] : {std::pair{SIGINT, "0"}, {SIGTERM, "0"}, {SIGINT, "2"}}) {
    const ScratchFolder folder;
    // Minutes of work, if nobody stopped it.
    Program program({"bake", "--generator", "fault", "--set", "faults=5000", "--patches", "0", "0", "200",
                     "200", "--workers", workers, "-o", folder / "a.r32"});
    ASSERT_TRUE(waitForAFile(folder.path()));
    program.signal(signal);
    const Answer answer = program.finish();
    EXPECT_EQ(answer.exitCode, 1);
    EXPECT_TRUE(isOneSentence(answer.complaint)) << answer.complaint;
    EXPECT_NE(answer.complaint.find("interrupted"), std::string::npos) << answer.complaint;
    EXPECT_EQ(answer.output, "");
    EXPECT_TRUE(namesIn(folder.path()).empty());
  }
}

/// Waits until the one file in a folder holds something.
bool waitForBytes(const std::filesystem::path& folder) {
  for (int tries = 0; tries < 6000; ++tries) {
    const std::vector<std::string> names = namesIn(folder);
    std::error_code gone;
    if (!names.empty() && std::filesystem::file_size(folder / names.front(), gone) > 0 && !gone) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

TEST(Bake, StopsCleanlyWhenInterruptedWhileItWritesTriangles) {
  for (const std::string name : {"a.obj", "a.iv"}) {
    const ScratchFolder folder;
    // Quickly made, long to write: 17 million vertices.
    Program program(
        {"bake", "--generator", "flat", "--patches", "0", "0", "128", "128", "-o", folder / name});
    ASSERT_TRUE(waitForBytes(folder.path()));
    program.signal(SIGINT);
    const Answer answer = program.finish();
    EXPECT_EQ(answer.exitCode, 1);
    EXPECT_TRUE(isOneSentence(answer.complaint)) << answer.complaint;
    EXPECT_NE(answer.complaint.find("interrupted"), std::string::npos) << answer.complaint;
    EXPECT_TRUE(namesIn(folder.path()).empty());
  }
}

}  // namespace
}  // namespace teren
