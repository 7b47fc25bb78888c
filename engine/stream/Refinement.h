// The way from what is drawn to what is wanted, a step at a time: no hole, no overlap, at any moment (law 5).
#pragma once

#include <cstddef>

#include "stream/NodeStore.h"
#include "stream/Selection.h"

namespace teren {

/// The next change that brings the drawn set nearer to a selection, of up to `most` steps of one kind; empty
/// where none is possible before more nodes are held. In this order:
/// 1. What lies under no root of the selection goes, root by root.
/// 2. A leaf whose heights are held takes the place of all finer nodes drawn in it.
/// 3. The most urgent first: a node whose heights are held comes where nothing is drawn, roots before what is
/// below
///    them; a drawn node above the cut is exchanged for its four children once all of them are held and no
///    coarser node touches it.
/// So levels of neighbours differ by more than one only beside new roots and after 2.
/// O(nodes drawn and selected), about 0.2 us each.
DrawnChange nextChange(const NodeStore& nodes, const Selection& wanted, std::size_t most);

}  // namespace teren
