#include "apps/sandbox/SandFile.h"

#include <array>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <span>
#include <vector>

#include "teren/Quote.h"

#include "apps/files/InputFile.h"
#include "apps/files/OutputFile.h"
#include "apps/files/RowWriter.h"
#include "generators/sand/SandArchive.h"

namespace teren {
namespace {

/// Writes a file whole or not at all; `write` gets its stream.
template <class Write>
Result<void> writeWhole(const std::string& file, const Write& write) {
  Result<OutputFile> output = OutputFile::create(file);
  if (!output) return output.error();
  if (const Result<void> written = write(output->stream()); !written) {
    return Error{"cannot write " + inQuotes(file) + ": " + written.error().message};
  }
  return output->commit();
}

/// Not of length 1: the sum of the normals of the faces at a vertex, each as long as twice its area.
std::array<double, 3> areaNormal(const Triangulation& mesh, VertexId v) {
  const LatticeFrame& frame = mesh.frame();
  const LatticePoint p = mesh.point(v);
  std::array<double, 3> sum{};
  mesh.forEachCorner(v, [&](Link at) {
    const std::array<VertexId, 3>& corners = mesh.corners(at.triangle());
    const VertexId b = corners[following(at.side())], c = corners[preceding(at.side())];
    const double xb = (mesh.point(b).x - p.x) * frame.step, yb = (mesh.point(b).y - p.y) * frame.step;
    const double xc = (mesh.point(c).x - p.x) * frame.step, yc = (mesh.point(c).y - p.y) * frame.step;
    const double zb = mesh.height(b) - mesh.height(v), zc = mesh.height(c) - mesh.height(v);
    sum[0] += yb * zc - zb * yc;
    sum[1] += zb * xc - xb * zc;
    sum[2] += xb * yc - yb * xc;
  });
  return sum;
}

/// The living vertices, each a row, and their numbers, which .obj counts from 1.
Result<void> objVertices(RowWriter& out, const Triangulation& mesh, std::vector<std::uint32_t>& numbers) {
  numbers.assign(mesh.vertexSlots(), 0);
  std::uint32_t count = 0;
  return out.rows(mesh.vertexSlots(), [&](VertexId v) {
    if (!mesh.isVertex(v)) return;
    numbers[v] = ++count;
    out << "v ";
    out.shortest(mesh.frame().placeX(mesh.point(v))) << " ";
    out.shortest(mesh.frame().placeY(mesh.point(v))) << " ";
    out.shortest(mesh.height(v));
    const std::array<double, 3> n = areaNormal(mesh, v);
    const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    out << "\nvn ";
    out.rounded(n[0] / length) << " ";
    out.rounded(n[1] / length) << " ";
    out.rounded(n[2] / length) << "\n";
  });
}

Result<void> writeObj(const Triangulation& mesh, std::FILE* stream) {
  const RowProgress goOn = [](std::size_t, std::size_t) { return true; };
  RowWriter out(stream, goOn, std::size_t{mesh.vertexSlots()} + mesh.triangleSlots());
  out << "# Sand made by teren: " << mesh.vertexCount() << " vertices, " << mesh.triangleCount()
      << " triangles.\n# Metres east, north and up (z).\no sand\n";
  std::vector<std::uint32_t> numbers;
  if (Result<void> written = objVertices(out, mesh, numbers); !written) return written;
  return out.rows(mesh.triangleSlots(), [&](TriangleId t) {
    if (!mesh.isTriangle(t)) return;
    out << "f";
    for (const VertexId v : mesh.corners(t)) {
      const std::size_t number = numbers[v];
      out << " " << number << "//" << number;
    }
    out << "\n";
  });
}

}  // namespace

Result<void> saveSand(const std::string& file, const Sandbox& sandbox) {
  return writeWhole(file, [&sandbox](std::FILE* stream) -> Result<void> {
    const std::vector<std::byte> bytes = archived(sandbox);
    const bool written = std::fwrite(bytes.data(), 1, bytes.size(), stream) == bytes.size();
    if (!written) return Error{std::string("the disk refuses: ") + std::strerror(errno)};
    return {};
  });
}

Result<Sandbox> loadSand(const std::string& file) {
  const Result<std::string> bytes = readFile(file, kMostSandBytes);
  if (!bytes) return bytes.error();
  Result<Sandbox> sandbox = restored(std::as_bytes(std::span(*bytes)));
  if (!sandbox) return Error{inQuotes(file) + ": " + sandbox.error().message};
  return sandbox;
}

Result<void> exportObj(const std::string& file, const Sandbox& sandbox) {
  return writeWhole(file, [&](std::FILE* stream) { return writeObj(sandbox.surface().mesh(), stream); });
}

}  // namespace teren
