#include "world/FieldTask.h"

#include <algorithm>
#include <cassert>
#include <limits>

#include "teren/HeightMapOperations.h"
#include "teren/StepLimit.h"

namespace teren {

FieldTask::FieldTask(const Layer& layer, const FieldRequest& request, HeightView out)
    : layer_(layer),
      request_(request),
      out_(out),
      work_(layer, 0, stepLimit(request.columns, request.rows),
            [this] { return layer_.field()->beginField(request_, out_); }) {
  assert(layer.field() != nullptr && out.columns() == request.columns && out.rows() == request.rows);
}

bool FieldTask::step(const Slice& slice) {
  if (!begun_) {
    begun_ = true;
    // What a plugin leaves out must not be what happened to lie there.
    fillHeights(out_, std::numeric_limits<float>::quiet_NaN());
  }
  if (state_ == PluginWork::State::working) {
    state_ = work_.step(slice);
    if (state_ == PluginWork::State::working) return false;
    if (state_ == PluginWork::State::failed) {
      failed_ = true;
      fillHeights(out_, static_cast<float>(layer_.range().mean));
      layer_.reportFailure(work_.failure(), request_.i, request_.j);
      checked_ = out_.rows();
    }
    if (slice.over()) return false;
  }
  while (checked_ < out_.rows()) {
    checkRow(checked_++);
    if (slice.over()) break;
  }
  return checked_ == out_.rows();
}

void FieldTask::checkRow(int row) {
  float* const heights = out_.row(row);
  for (int column = 0; column < out_.columns(); ++column) {
    if (layer_.accepts(heights[column])) continue;
    if (!failed_) layer_.reportFailure(layer_.refusal(heights[column]), request_.i, request_.j);
    failed_ = true;
    heights[column] = static_cast<float>(layer_.range().mean);
  }
}

}  // namespace teren
