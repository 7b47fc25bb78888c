#include "stream/JoinTask.h"

#include <utility>

namespace teren {

JoinTask::JoinTask(NodeStore& nodes, DrawnChange change) : change_(std::move(change)) {
  ChangePlan plan = nodes.plan(change_);
  bytes_ = plan.bytes;
  for (PiecePlan& piece : plan.build) {
    tasks_.push_back(nodes.makePiece(piece));
    pieces_.push_back({std::move(piece), nullptr});
  }
}

void JoinTask::add(PiecePlan plan, std::unique_ptr<PieceTask> task) {
  tasks_.push_back(std::move(task));
  pieces_.push_back({std::move(plan), nullptr});
}

std::optional<BuiltPiece> JoinTask::takePiece() {
  if (pieces_.empty()) return std::nullopt;
  std::optional<BuiltPiece> piece(std::move(pieces_.back()));
  pieces_.pop_back();
  return piece;
}

bool JoinTask::step(const Slice& slice) {
  while (next_ < tasks_.size()) {
    if (!tasks_[next_]->step(slice)) return false;
    pieces_[next_].mesh = tasks_[next_]->takeResult();
    tasks_[next_++].reset();
    if (slice.over()) break;
  }
  return next_ == tasks_.size();
}

}  // namespace teren
