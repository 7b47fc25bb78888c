#include "apps/check/MapMaker.h"
#include "apps/check/Properties.h"
#include "apps/check/Subject.h"

namespace teren::check {
namespace {

class Completion final : public Property {
 public:
  std::string_view name() const noexcept override { return "completion"; }
  std::string_view demand() const noexcept override {
    return "Every map of any size and level is begun and completed, and nothing is thrown.";
  }

 protected:
  std::string holds(const Subject& subject, const Effort&) const override {
    int maps = 0;
    for (const Setting& setting : subject.settings()) {
      const MapMaker maker = subject.maker(setting);
      for (const int samples : {3, 5, 9, 17, 33}) {
        for (int level = 0; level <= 6; ++level, ++maps) maker.make(requestOf(level, samples, level));
      }
    }
    for (const int samples : {65, 129, 257}) {
      subject.maker({}).make(requestOf(1, samples));
      ++maps;
    }
    return std::to_string(maps) + " maps";
  }
};

}  // namespace

PropertyPointer makeCompletion() {
  return std::make_unique<Completion>();
}

}  // namespace teren::check
