// Makes the properties, one source file each; Contract.cpp puts them in order.
#pragma once

#include <memory>

#include "apps/check/Property.h"

namespace teren::check {

using PropertyPointer = std::unique_ptr<const Property>;

PropertyPointer makeCompletion();
PropertyPointer makeSlicing();
PropertyPointer makeOrder();
PropertyPointer makeThreads();
PropertyPointer makeParallel();
PropertyPointer makeSliceLength();
PropertyPointer makeFinite();
PropertyPointer makeRange();
PropertyPointer makeMean();
PropertyPointer makeDeviation();
PropertyPointer makeResidual();
PropertyPointer makeLevels();
PropertyPointer makeField();
PropertyPointer makeFieldError();
PropertyPointer makeParameters();
PropertyPointer makeCancellation();
PropertyPointer makeMargins();
PropertyPointer makeMemory();
PropertyPointer makeAllocation();

// Of deformers.
PropertyPointer makeStamps();
PropertyPointer makeStepSlicing();
PropertyPointer makeCollar();
PropertyPointer makeChanged();
PropertyPointer makeHeights();
PropertyPointer makeHostile();
PropertyPointer makeSurfaces();
PropertyPointer makeSnapshots();
PropertyPointer makeBytes();
PropertyPointer makeStepLength();
PropertyPointer makeGrowth();
PropertyPointer makeLoose();

}  // namespace teren::check
