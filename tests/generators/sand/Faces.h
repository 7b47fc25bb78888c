// Random faces for the tests of sand: ordinary ones, slivers, huge and tiny ones, bare and buried corners.
#pragma once

#include <algorithm>
#include <cstdint>

#include "teren/Hash.h"

#include "generators/sand/FaceSlide.h"

namespace teren {

/// A face with edges up to 2^edgeBits steps, heights up to 2^heightBits ticks and corners that bear from
/// nothing to 2^heightBits ticks of loose material; one corner in `bareOneIn` bears none (0: none does).
inline Face randomFace(RandomSequence& random, int edgeBits, int heightBits, int bareOneIn) {
  Face face;
  std::int64_t area = 0;
  while (area <= 0) {
    for (FaceCorner& corner : face) {
      corner.place = {static_cast<std::int32_t>(random.nextBits(edgeBits)),
                      static_cast<std::int32_t>(random.nextBits(edgeBits))};
    }
    area = orientation(face[0].place, face[1].place, face[2].place);
  }
  for (FaceCorner& corner : face) {
    const int around = static_cast<int>(random.nextBits(4));
    corner.weight = 2 * area + random.nextBits(std::max(1, 1 + 2 * edgeBits - 8 * (around & 1))) %
                                   (area * (1 + around) + 1);
    corner.height = random.nextBits(heightBits);
    corner.loose = kBareTicks + 1 + random.nextBits(heightBits);
    if (bareOneIn > 0 && random.next() % static_cast<std::uint64_t>(bareOneIn) == 0) {
      corner.loose = random.nextBits(18);
    }
  }
  return face;
}

/// A face of one lattice step's width and up to 2^lengthBits steps' length: twice its area is 1.
inline Face sliver(RandomSequence& random, int lengthBits, int heightBits) {
  Face face = randomFace(random, 8, heightBits, 0);
  const auto length = static_cast<std::int32_t>(random.nextBits(lengthBits) + 2);
  face[0].place = {0, 0};
  face[1].place = {length, 1};
  face[2].place = {length - 1, 1};
  if (orientation(face[0].place, face[1].place, face[2].place) < 0) std::swap(face[1].place, face[2].place);
  return face;
}

inline void apply(Face& face, const FaceMove& move, VolumeLedger& ledger) {
  ledger.enter(volumeOf(face, move));
  for (std::size_t i = 0; i < 3; ++i) {
    face[i].height += move[i];
    face[i].loose += move[i];
  }
}

}  // namespace teren
