// How the programs that make land for hours keep their memory in one piece.
#pragma once

namespace teren {

/// Blocks of 16 KiB and more - base maps, above all - come from the system one by one and go back to it when
/// they are freed, each rounded up to whole pages. Call before the land is made. Otherwise the C library puts
/// them between smaller ones; meshes then move into the holes that freed maps leave, the next maps find no
/// room, and a flight over one level grows by a tenth in ten minutes, although the engine holds the same.
/// For a whole process, so it is the program's to decide, not the library's. Costs about 5 us a map.
void keepLargeBlocksApart() noexcept;

}  // namespace teren
