// The stages of InverseTransform, compiled once for each width of vector registers: InverseTransform.cpp
// includes this file several times, with TEREN_VECTOR_BYTES defined, inside namespaces of their own. All
// arithmetic is lane by lane, so bits do not depend on the width.

/// As many floats as a register holds.
typedef float Vector __attribute__((vector_size(TEREN_VECTOR_BYTES), may_alias));
constexpr int kVector = sizeof(Vector) / sizeof(float);

TEREN_ALWAYS_INLINE Vector& vectorAt(float* lanes) {
  return *reinterpret_cast<Vector*>(lanes);
}

/// to = from * turn; the two may be the same cell.
TEREN_ALWAYS_INLINE void turned(Cell& from, Harmonic turn, Cell& to) {
  for (int lane = 0; lane < kLanes; lane += kVector) {
    const Vector re = vectorAt(from.re + lane), im = vectorAt(from.im + lane);
    vectorAt(to.re + lane) = re * turn.re - im * turn.im;
    vectorAt(to.im + lane) = re * turn.im + im * turn.re;
  }
}

/// a, b = a + b, (a - b) * turn
TEREN_ALWAYS_INLINE void butterfly(Cell& a, Cell& b, Harmonic turn) {
  for (int lane = 0; lane < kLanes; lane += kVector) {
    const Vector aRe = vectorAt(a.re + lane), aIm = vectorAt(a.im + lane);
    const Vector bRe = vectorAt(b.re + lane), bIm = vectorAt(b.im + lane);
    vectorAt(a.re + lane) = aRe + bRe;
    vectorAt(a.im + lane) = aIm + bIm;
    const Vector re = aRe - bRe, im = aIm - bIm;
    vectorAt(b.re + lane) = re * turn.re - im * turn.im;
    vectorAt(b.im + lane) = re * turn.im + im * turn.re;
  }
}

/// a, b = a + b, a - b
TEREN_ALWAYS_INLINE void butterfly(Cell& a, Cell& b) {
  for (int lane = 0; lane < kLanes; lane += kVector) {
    const Vector aRe = vectorAt(a.re + lane), aIm = vectorAt(a.im + lane);
    const Vector bRe = vectorAt(b.re + lane), bIm = vectorAt(b.im + lane);
    vectorAt(a.re + lane) = aRe + bRe;
    vectorAt(a.im + lane) = aIm + bIm;
    vectorAt(b.re + lane) = aRe - bRe;
    vectorAt(b.im + lane) = aIm - bIm;
  }
}

/// even, odd = a + conj b, (a - conj b) * turn; even and odd may be a and b or other cells.
TEREN_ALWAYS_INLINE void conjugateButterfly(Cell& a, Cell& b, int lane, Harmonic turn, Vector& evenRe,
                                            Vector& evenIm, Vector& oddRe, Vector& oddIm) {
  const Vector aRe = vectorAt(a.re + lane), aIm = vectorAt(a.im + lane);
  const Vector bRe = vectorAt(b.re + lane), bIm = vectorAt(b.im + lane);
  evenRe = aRe + bRe;
  evenIm = aIm - bIm;
  const Vector re = aRe - bRe, im = aIm + bIm;
  oddRe = re * turn.re - im * turn.im;
  oddIm = re * turn.im + im * turn.re;
}

/// One stage of complex transforms of `size` cells, all those of cells[0 ... count). Harmonics beyond
/// +-largest are zero where that says anything. `stride` leads from turn to turn.
void complexStage(Cell* cells, int count, int size, int largest, const Harmonic* turns, int stride) {
  const int half = size / 2;
  for (Cell* even = cells; even < cells + count; even += size) {
    Cell* const odd = even + half;
    if (4 * largest < size) {
      odd[0] = even[0];
      for (int k = 1; k <= largest; ++k) {
        const Harmonic turn = turns[k * stride];
        turned(even[k], turn, odd[k]);
        even[half - k] = odd[half - k];
        turned(odd[half - k], {turn.re, -turn.im}, odd[half - k]);
      }
    } else {
      butterfly(even[0], odd[0]);
      for (int k = 1; k < half; ++k) butterfly(even[k], odd[k], turns[k * stride]);
    }
  }
}

/// The even half of a complex stage alone.
void complexFold(Cell* cells, int size) {
  float* const even = cells->re;
  const float* const odd = cells[size / 2].re;
  for (int n = 0; n < size / 2 * 2 * kLanes; ++n) even[n] += odd[n];
}

/// The harmonics 0 ... size / 2 of a real transform lie in size / 2 cells; those at 0 and size / 2 are real
/// and share the first, as its two parts.
TEREN_ALWAYS_INLINE void realEnds(Cell& first, Cell& middle) {
  for (int lane = 0; lane < kLanes; lane += kVector) {
    const Vector a = vectorAt(first.re + lane), b = vectorAt(first.im + lane);
    const Vector re = vectorAt(middle.re + lane), im = vectorAt(middle.im + lane);
    vectorAt(first.re + lane) = a + b;
    vectorAt(first.im + lane) = re + re;
    vectorAt(middle.re + lane) = a - b;
    vectorAt(middle.im + lane) = -(im + im);
  }
}

/// Harmonics k and half - k of a real transform become k of its even and odd transform, and with them those
/// at quarter - k and quarter + k, which share their cells; k < quarter - k.
TEREN_ALWAYS_INLINE void realQuad(Cell* cells, int quarter, int k, Harmonic turn, Harmonic opposite) {
  Cell &a = cells[k], &b = cells[2 * quarter - k], &c = cells[quarter - k], &d = cells[quarter + k];
  for (int lane = 0; lane < kLanes; lane += kVector) {
    Vector evenRe, evenIm, oddRe, oddIm, evenRe2, evenIm2, oddRe2, oddIm2;
    conjugateButterfly(a, b, lane, turn, evenRe, evenIm, oddRe, oddIm);
    conjugateButterfly(c, d, lane, opposite, evenRe2, evenIm2, oddRe2, oddIm2);
    vectorAt(a.re + lane) = evenRe;
    vectorAt(a.im + lane) = evenIm;
    vectorAt(d.re + lane) = oddRe;
    vectorAt(d.im + lane) = oddIm;
    vectorAt(c.re + lane) = evenRe2;
    vectorAt(c.im + lane) = evenIm2;
    vectorAt(b.re + lane) = oddRe2;
    vectorAt(b.im + lane) = oddIm2;
  }
}

/// One stage of real transforms of `size` samples, size >= 4, all those of cells[0 ... count).
void realStage(Cell* cells, int count, int size, int largest, const Harmonic* turns, int stride) {
  const int quarter = size / 4;
  for (Cell* even = cells; even < cells + count; even += 2 * quarter) {
    Cell* const odd = even + quarter;
    if (largest < quarter) {
      odd[0] = even[0];
      for (int k = 1; k <= largest; ++k) turned(even[k], turns[k * stride], odd[k]);
      continue;
    }
    realEnds(even[0], odd[0]);
    int k = 1;
    for (; k < quarter - k; ++k) {
      realQuad(even, quarter, k, turns[k * stride], turns[(quarter - k) * stride]);
    }
    if (2 * k != quarter) continue;
    const Harmonic turn = turns[k * stride];
    for (int lane = 0; lane < kLanes; lane += kVector) {
      Vector evenRe, evenIm, oddRe, oddIm;
      conjugateButterfly(even[k], odd[k], lane, turn, evenRe, evenIm, oddRe, oddIm);
      vectorAt(even[k].re + lane) = evenRe;
      vectorAt(even[k].im + lane) = evenIm;
      vectorAt(odd[k].re + lane) = oddRe;
      vectorAt(odd[k].im + lane) = oddIm;
    }
  }
}

/// The even half of a real stage alone, in the same operations.
void realFold(Cell* cells, int size) {
  const int quarter = size / 4;
  realEnds(cells[0], cells[quarter]);
  for (int k = 1; k < quarter; ++k) {
    const Cell& opposite = cells[2 * quarter - k];
    for (int lane = 0; lane < kLanes; ++lane) {
      cells[k].re[lane] += opposite.re[lane];
      cells[k].im[lane] -= opposite.im[lane];
    }
  }
}

constexpr Stages kStages = {complexStage, complexFold, realStage, realFold};
