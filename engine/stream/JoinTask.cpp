#include "stream/JoinTask.h"

#include <cassert>

namespace teren {

JoinTask::JoinTask(NodeStore& nodes, std::span<const NodeKey> batch) {
  NodeSet before;
  for (const NodeKey& node : batch) {
    assert(nodes.heights(node) && !nodes.isDrawn(node));
    Joined& joined = joined_.emplace_back(Joined{node, {}});
    for (const PieceName& name : nodes.piecesToDraw(node, before)) {
      joined.pieces.push_back({name, nullptr});
      tasks_.push_back(nodes.makePiece(name));
    }
    before.insert(node);
  }
}

bool JoinTask::step(const Slice& slice) {
  while (node_ < joined_.size()) {
    std::vector<BuiltPiece>& pieces = joined_[node_].pieces;
    if (piece_ == pieces.size()) {
      ++node_;
      piece_ = 0;
      continue;
    }
    if (!tasks_[task_]->step(slice)) return false;
    pieces[piece_++].mesh = tasks_[task_]->takeResult();
    tasks_[task_++].reset();
    if (slice.over()) break;
  }
  return task_ == tasks_.size();
}

}  // namespace teren
