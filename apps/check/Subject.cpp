#include "apps/check/Subject.h"

#include <cassert>
#include <utility>

namespace teren::check {

Subject::Subject(std::shared_ptr<const PluginRegistry> registry, const std::string& id,
                 const std::vector<Setting>& more)
    : registry_(std::move(registry)), info_(registry_->find(id)) {
  assert(info_ != nullptr);
  candidates_ = settingsOf(info_->parameters);
  candidates_.insert(candidates_.end(), more.begin(), more.end());
  for (const Setting& setting : candidates_) {
    if (refusal(setting).empty()) settings_.push_back(setting);
  }
  // Without its defaults a plugin is not tried at all.
  if (!settings_.empty() && !settings_.front().empty()) settings_.clear();
}

std::string Subject::refusal(const Setting& setting) const {
  if (info_->kind == PluginKind::deformer) {
    const auto deformer = registry_->makeDeformer(info_->id);
    if (!deformer) return deformer.error().message;
    const auto values = Values::check(info_->parameters, setting, info_->id);
    return values ? "" : values.error().message;
  }
  if (info_->kind == PluginKind::filter) {
    const auto filter = registry_->makeFilter(info_->id, setting);
    return filter ? "" : filter.error().message;
  }
  const auto generator = registry_->makeGenerator(info_->id, setting);
  return generator ? "" : generator.error().message;
}

std::shared_ptr<const Deformer> Subject::deformer() const {
  return registry_->makeDeformer(info_->id).value();
}

MapMaker Subject::maker(const Setting& setting) const {
  if (info_->kind == PluginKind::filter) {
    return MapMaker(registry_->makeFilter(info_->id, setting).value(), textOf(setting));
  }
  return MapMaker(registry_->makeGenerator(info_->id, setting).value(), textOf(setting));
}

}  // namespace teren::check
