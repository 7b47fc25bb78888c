#include "apps/teren/HeightFile.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <cmath>
#include <csetjmp>
#include <cstring>
#include <png.h>
#include <string>
#include <vector>

#include "teren/Hash.h"
#include "teren/HeightMapOperations.h"
#include "teren/Quote.h"

namespace teren {
namespace {

/// The four bytes of a height in a .r32 file; zero has one form only.
std::array<std::uint8_t, 4> heightBytes(float height) noexcept {
  const auto bits = std::bit_cast<std::uint32_t>(height == 0.0F ? 0.0F : height);
  return {static_cast<std::uint8_t>(bits), static_cast<std::uint8_t>(bits >> 8U),
          static_cast<std::uint8_t>(bits >> 16U), static_cast<std::uint8_t>(bits >> 24U)};
}

Error diskError() {
  return {std::string("the disk refuses: ") + std::strerror(errno)};
}

Error interrupted() {
  return {"interrupted"};
}

Result<void> writeR32(ConstHeightView heights, std::FILE* stream, const RowProgress& progress) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(heights.columns()) * 4);
  for (int row = 0; row < heights.rows(); ++row) {
    if (!progress(static_cast<std::size_t>(row), static_cast<std::size_t>(heights.rows())))
      return interrupted();
    for (int column = 0; column < heights.columns(); ++column) {
      const auto sample = heightBytes(heights(column, row));
      std::copy(sample.begin(), sample.end(), bytes.begin() + static_cast<std::ptrdiff_t>(column) * 4);
    }
    if (std::fwrite(bytes.data(), 1, bytes.size(), stream) != bytes.size()) return diskError();
  }
  return {};
}

/// libpng's writing half. Its errors come by longjmp, so each step that may fail is a function of its own
/// without objects to destroy.
class PngWriter {
 public:
  PngWriter() : png_(png_create_write_struct(PNG_LIBPNG_VER_STRING, this, &onError, &onWarning)) {
    if (png_ != nullptr) info_ = png_create_info_struct(png_);
  }
  ~PngWriter() { png_destroy_write_struct(&png_, &info_); }
  PngWriter(const PngWriter&) = delete;
  PngWriter& operator=(const PngWriter&) = delete;

  bool begin(std::FILE* stream, int columns, int rows) {
    if (png_ == nullptr || info_ == nullptr) return false;
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_set_user_limits(png_, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
    png_init_io(png_, stream);
    png_set_IHDR(png_, info_, static_cast<png_uint_32>(columns), static_cast<png_uint_32>(rows), 16,
                 PNG_COLOR_TYPE_GRAY, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    png_write_info(png_, info_);
    return true;
  }
  bool row(const std::uint8_t* bytes) {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_write_row(png_, bytes);
    return true;
  }
  bool end() {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_write_end(png_, info_);
    return true;
  }
  Error error() const { return {"the picture cannot be written: " + message_}; }

 private:
  static void onError(png_structp png, png_const_charp text) {
    static_cast<PngWriter*>(png_get_error_ptr(png))->message_ = shortened(text);
    png_longjmp(png, 1);
  }
  static void onWarning(png_structp, png_const_charp) {}

  std::string message_ = "libpng cannot begin";
  png_structp png_;
  png_infop info_ = nullptr;
};

Result<void> writePng(ConstHeightView heights, std::FILE* stream, const RowProgress& progress) {
  const auto wanted = static_cast<std::size_t>(heights.rows());
  const HeightStatistics range = statistics(heights);
  const double scale = range.max > range.min ? 65535.0 / (range.max - range.min) : 0.0;
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(heights.columns()) * 2);
  PngWriter writer;
  if (!writer.begin(stream, heights.columns(), heights.rows())) return writer.error();
  for (int row = heights.rows() - 1; row >= 0; --row) {
    if (!progress(wanted - 1 - static_cast<std::size_t>(row), wanted)) return interrupted();
    for (int column = 0; column < heights.columns(); ++column) {
      const double level = std::floor((static_cast<double>(heights(column, row)) - range.min) * scale + 0.5);
      const auto grey = static_cast<std::uint32_t>(std::min(level, 65535.0));
      bytes[static_cast<std::size_t>(column) * 2] = static_cast<std::uint8_t>(grey >> 8U);
      bytes[static_cast<std::size_t>(column) * 2 + 1] = static_cast<std::uint8_t>(grey);
    }
    if (!writer.row(bytes.data())) return writer.error();
  }
  if (!writer.end()) return writer.error();
  return {};
}

}  // namespace

Result<HeightFormat> heightFormat(const std::filesystem::path& file) {
  const std::string extension = file.extension().string();
  if (extension == ".r32") return HeightFormat::r32;
  if (extension == ".png") return HeightFormat::png;
  if (extension == ".obj") return HeightFormat::obj;
  if (extension == ".iv") return HeightFormat::iv;
  const std::string reason = extension == ".tif"
                                 ? " asks for an elevation file, which needs a plugin that does not exist yet"
                                 : " asks for no format that can be written";
  return Error{"the name " + inQuotes(file.string()) + reason + "; end it in .r32, .png, .obj or .iv"};
}

std::uint64_t heightHash(ConstHeightView heights) noexcept {
  Fnv1a hash;
  for (int row = 0; row < heights.rows(); ++row) {
    for (int column = 0; column < heights.columns(); ++column) {
      for (const std::uint8_t byte : heightBytes(heights(column, row))) hash.addByte(byte);
    }
  }
  return hash.value();
}

Result<void> writeHeights(ConstHeightView heights, HeightFormat format, const GroundPlace& place,
                          std::FILE* stream, const RowProgress& progress) {
  switch (format) {
    case HeightFormat::r32:
      return writeR32(heights, stream, progress);
    case HeightFormat::png:
      return writePng(heights, stream, progress);
    case HeightFormat::obj:
      return writeObj(heights, place, stream, progress);
    case HeightFormat::iv:
      break;
  }
  return writeInventor(heights, place, stream, progress);
}

}  // namespace teren
