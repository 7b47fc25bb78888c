// The samples of a layer that is a continuous field: asked for, and checked at the door.
#pragma once

#include "teren/ContinuousGenerator.h"
#include "teren/HeightMap.h"
#include "teren/Slice.h"

#include "world/Layer.h"
#include "world/PluginWork.h"

namespace teren {

/// Fills a rectangle with a field's samples, in slices. Whatever the plugin does they come out finite: one
/// that is not, lies outside the promised range or was not written is the layer's mean, it alone, so that
/// heights stay a function of the position; where the plugin throws, begins no task or is never done (see
/// StepLimit.h) the whole rectangle is. The layer reports one sentence.
class FieldTask final : public SlicedTask {
 public:
  /// `layer`, whose field() is not null, and what `out` (request.columns x request.rows) looks at must
  /// outlive it.
  FieldTask(const Layer& layer, const FieldRequest& request, HeightView out);
  bool step(const Slice& slice) override;

  /// Whether the mean stands in for any sample; final once step has returned true.
  bool failed() const noexcept { return failed_; }

 private:
  void checkRow(int row);

  const Layer& layer_;
  FieldRequest request_;
  HeightView out_;
  PluginWork work_;
  PluginWork::State state_ = PluginWork::State::working;
  bool begun_ = false, failed_ = false;
  int checked_ = 0;  // rows
};

}  // namespace teren
