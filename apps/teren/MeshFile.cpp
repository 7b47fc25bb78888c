#include "apps/teren/MeshFile.h"

#include <array>
#include <cassert>
#include <string>

#include "teren/HeightSampling.h"
#include "teren/Parameter.h"

namespace teren {
namespace {

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
