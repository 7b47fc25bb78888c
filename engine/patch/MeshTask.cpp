#include "patch/MeshTask.h"

#include "height/Surface.h"

namespace teren {

PieceExtent pieceExtent(Piece piece, int intervals) noexcept {
  const int inside = intervals - 2;
  switch (piece) {
    case Piece::interior:
      return {1, 1, inside, inside};
    case Piece::eastSeam:
      return {intervals - 1, 1, 2, inside};
    case Piece::northSeam:
      return {1, intervals - 1, inside, 2};
    case Piece::cornerPiece:
    case Piece::border:
      break;
  }
  return {intervals - 1, intervals - 1, 2, 2};
}

std::size_t pieceBytes(Piece piece, int intervals) noexcept {
  const PieceExtent extent = pieceExtent(piece, intervals);
  return sizeof(Mesh) + static_cast<std::size_t>(extent.columns + 1) *
                            static_cast<std::size_t>(extent.rows + 1) * sizeof(SurfaceVertex);
}

std::shared_ptr<const TriangleIndices> GridIndices::get(int columns, int rows) {
  std::shared_ptr<const TriangleIndices>& list = lists_[{columns, rows}];
  if (list) return list;
  auto indices = std::make_shared<TriangleIndices>();
  indices->reserve(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows) * 6);
  const auto across = static_cast<std::uint32_t>(columns + 1);
  for (std::uint32_t y = 0; y < static_cast<std::uint32_t>(rows); ++y) {
    for (std::uint32_t x = 0; x < static_cast<std::uint32_t>(columns); ++x) {
      const std::uint32_t southWest = y * across + x, southEast = southWest + 1;
      const std::uint32_t northWest = southWest + across, northEast = northWest + 1;
      indices->insert(indices->end(), {southWest, southEast, northEast, southWest, northEast, northWest});
    }
  }
  bytes_ += indices->capacity() * sizeof(std::uint32_t);
  list = std::move(indices);
  return list;
}

MeshTask::MeshTask(NodeBlock block, Piece piece, double spacing, GridIndices& indices)
    : block_(std::move(block)),
      intervals_(block_.nodes[0]->columns() - 1),
      extent_(pieceExtent(piece, intervals_)),
      spacing_(spacing) {
  const std::int64_t stride = std::int64_t{1} << block_.key.level;
  mesh_->level = block_.key.level;
  mesh_->originColumn = (block_.key.i * intervals_ + extent_.firstColumn) * stride;
  mesh_->originRow = (block_.key.j * intervals_ + extent_.firstRow) * stride;
  mesh_->columns = extent_.columns;
  mesh_->rows = extent_.rows;
  mesh_->indices = indices.get(extent_.columns, extent_.rows);
}

bool MeshTask::step(const Slice& slice) {
  if (nextRow_ == 0) {
    mesh_->vertices.reserve(static_cast<std::size_t>(extent_.columns + 1) *
                            static_cast<std::size_t>(extent_.rows + 1));
  }
  while (nextRow_ <= extent_.rows) {
    buildRow(nextRow_++);
    if (slice.over()) break;
  }
  return nextRow_ > extent_.rows;
}

const NodeHeights& MeshTask::nodeAt(int& column, int& row) const {
  std::size_t node = 0;
  if (column > intervals_) {
    column -= intervals_;
    node += 1;
  }
  if (row > intervals_) {
    row -= intervals_;
    node += 2;
  }
  return block_.nodes[node];
}

float MeshTask::heightAt(int column, int row) const {
  const NodeHeights& node = nodeAt(column, row);
  return (*node)(column, row);
}

void MeshTask::buildRow(int row) {
  for (int column = 0; column <= extent_.columns; ++column) {
    int x = extent_.firstColumn + column, y = extent_.firstRow + row;
    SurfaceVertex vertex;
    vertex.column = static_cast<std::int16_t>(column);
    vertex.row = static_cast<std::int16_t>(row);
    vertex.height = heightAt(x, y);
    const PackedNormal normal = vertexNormal(heightAt(x - 1, y), heightAt(x + 1, y), heightAt(x, y - 1),
                                             heightAt(x, y + 1), spacing_);
    vertex.normalX = normal.x;
    vertex.normalY = normal.y;
    const NodeHeights& node = nodeAt(x, y);
    setCoarser(vertex, node.coarser(), block_.key.level, spacing_, x, y);
    addVertex(vertex);
  }
}

}  // namespace teren
