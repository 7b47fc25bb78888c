#include "apps/teren/MeshFile.h"

#include <array>
#include <cassert>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <string>
#include <string_view>

#include "teren/HeightSampling.h"
#include "teren/Parameter.h"

namespace teren {
namespace {

constexpr int kNormalDecimals = 4;

/// Text on its way to a stream, row by row, with the questions between the rows.
class RowWriter {
 public:
  RowWriter(std::FILE* stream, const RowProgress& progress, std::size_t rows)
      : stream_(stream), progress_(progress), wanted_(rows) {}

  RowWriter& operator<<(std::string_view text) {
    text_ += text;
    return *this;
  }
  RowWriter& operator<<(std::size_t number) { return append(number); }
  /// The fewest digits that give the same number back; never an exponent, which not every reader knows.
  template <class Real>
  RowWriter& shortest(Real number) {
    return append(number == 0 ? Real{0} : number, std::chars_format::fixed);
  }
  RowWriter& rounded(double number) { return append(number, std::chars_format::fixed, kNormalDecimals); }

  /// Writes what was appended since the last call.
  Result<void> flush() {
    const bool written = std::fwrite(text_.data(), 1, text_.size(), stream_) == text_.size();
    text_.clear();
    if (!written) return Error{std::string("the disk refuses: ") + std::strerror(errno)};
    return {};
  }
  /// A block of rows, each appended by `row(index)` and written.
  template <class Row>
  Result<void> rows(int count, const Row& row) {
    for (int index = 0; index < count; ++index) {
      if (!progress_(done_++, wanted_)) return Error{"interrupted"};
      row(index);
      if (Result<void> written = flush(); !written) return written;
    }
    return {};
  }

 private:
  template <class... Arguments>
  RowWriter& append(Arguments... number) {
    std::array<char, 400> digits{};  // the smallest and largest doubles have over 300
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number...).ptr;
    text_.append(digits.data(), end);
    return *this;
  }

  std::FILE* stream_;
  const RowProgress& progress_;
  std::size_t done_ = 0, wanted_;
  std::string text_;
};

/// A rectangle of heights as vertices, counted row by row from the south-west.
class Net {
 public:
  Net(ConstHeightView heights, const GroundPlace& place) : heights_(heights), place_(place) {
    assert(heights.columns() >= 2 && heights.rows() >= 2);
  }

  int columns() const noexcept { return heights_.columns(); }
  int rows() const noexcept { return heights_.rows(); }
  std::size_t number(int column, int row) const noexcept {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns()) +
           static_cast<std::size_t>(column);
  }

  void comment(RowWriter& out) const {
    const auto metres = [&](std::int64_t patch) { return static_cast<double>(patch) * place_.pitch; };
    out << "# Landscape made by teren: " << static_cast<std::size_t>(columns()) << " x "
        << static_cast<std::size_t>(rows()) << " heights, " << numberText(place_.spacing)
        << " m apart.\n# Metres east, north and up (z), east and north "
        << "from the south-west corner at\n# x = " << numberText(metres(place_.i))
        << " m, y = " << numberText(metres(place_.j)) << " m of the world: the corner of patch ("
        << std::to_string(place_.i) << ", " << std::to_string(place_.j) << ") of pitch "
        << numberText(place_.pitch) << " m.\n";
  }
  void vertex(RowWriter& out, int column, int row) const {
    out.shortest(column * place_.spacing) << " ";
    out.shortest(row * place_.spacing) << " ";
    out.shortest(heights_(column, row));
  }
  void normal(RowWriter& out, int column, int row) const {
    const std::array<double, 3> normal = normalAt(heights_, column, row, place_.spacing);
    out.rounded(normal[0]) << " ";
    out.rounded(normal[1]) << " ";
    out.rounded(normal[2]);
  }

 private:
  ConstHeightView heights_;
  const GroundPlace& place_;
};

void objVertices(RowWriter& out, const Net& net, int row) {
  for (int column = 0; column < net.columns(); ++column) {
    out << "v ";
    net.vertex(out, column, row);
    out << "\nvn ";
    net.normal(out, column, row);
    out << "\n";
  }
}

/// Vertices and normals are counted from 1, and alike.
void objTriangles(RowWriter& out, const Net& net, int row) {
  const auto corner = [&](int column, int y) {
    const std::size_t number = net.number(column, y) + 1;
    out << " " << number << "//" << number;
  };
  for (int column = 0; column + 1 < net.columns(); ++column) {
    out << "f";
    corner(column, row);
    corner(column + 1, row);
    corner(column + 1, row + 1);
    out << "\nf";
    corner(column, row);
    corner(column + 1, row + 1);
    corner(column, row + 1);
    out << "\n";
  }
}

/// From west to east, north before south: that splits the quads by the right diagonal.
void inventorStrip(RowWriter& out, const Net& net, int row) {
  for (int column = 0; column < net.columns(); ++column) {
    out << net.number(column, row + 1) << "," << net.number(column, row) << ",";
  }
  out << "-1,\n";
}

}  // namespace

Result<void> writeObj(ConstHeightView heights, const GroundPlace& place, std::FILE* stream,
                      const RowProgress& progress) {
  const Net net(heights, place);
  RowWriter out(stream, progress, static_cast<std::size_t>(net.rows()) * 2 - 1);
  net.comment(out);
  out << "o landscape\n";
  if (Result<void> written = out.rows(net.rows(), [&](int row) { objVertices(out, net, row); }); !written) {
    return written;
  }
  return out.rows(net.rows() - 1, [&](int row) { objTriangles(out, net, row); });
}

Result<void> writeInventor(ConstHeightView heights, const GroundPlace& place, std::FILE* stream,
                           const RowProgress& progress) {
  const Net net(heights, place);
  RowWriter out(stream, progress, static_cast<std::size_t>(net.rows()) * 3 - 1);
  const auto points = [&](int row) {
    for (int column = 0; column < net.columns(); ++column) {
      net.vertex(out, column, row);
      out << ",\n";
    }
  };
  const auto normals = [&](int row) {
    for (int column = 0; column < net.columns(); ++column) {
      net.normal(out, column, row);
      out << ",\n";
    }
  };
  out << "#Inventor V2.1 ascii\n";
  net.comment(out);
  out << "Separator {\nShapeHints { vertexOrdering COUNTERCLOCKWISE }\nCoordinate3 { point [\n";
  if (Result<void> written = out.rows(net.rows(), points); !written) return written;
  out << "] }\nNormal { vector [\n";
  if (Result<void> written = out.rows(net.rows(), normals); !written) return written;
  out << "] }\nNormalBinding { value PER_VERTEX_INDEXED }\nIndexedTriangleStripSet { coordIndex [\n";
  if (Result<void> written = out.rows(net.rows() - 1, [&](int row) { inventorStrip(out, net, row); });
      !written) {
    return written;
  }
  out << "] }\n}\n";
  return out.flush();
}

}  // namespace teren
