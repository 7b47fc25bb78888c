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
