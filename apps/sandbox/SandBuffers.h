// A snapshot of sand in one GL context's buffers, kept in step by uploading the pages that differ.
#pragma once

#include <cstddef>
#include <memory>

#include "generators/sand/SandSnapshot.h"

namespace teren {

/// A vertex and an index buffer as long as the snapshot's slots, an eighth to spare: 20 bytes a vertex slot,
/// 12 a triangle slot. An index buffer's page draws nothing where no triangle is. Construction needs no
/// context; everything else needs this object's to be the current one, and leaves buffers bound.
class SandBuffers {
 public:
  SandBuffers() = default;
  SandBuffers(const SandBuffers&) = delete;
  SandBuffers& operator=(const SandBuffers&) = delete;

  /// Uploads what differs from the last snapshot: O(pages that differ), and O(n) the first time and where it
  /// has outgrown the buffers.
  void follow(std::shared_ptr<const SandSnapshot> sand);
  /// Binds both buffers.
  void bind() const;
  /// Frees everything at once.
  void clear();

  /// [bytes] that the buffers take.
  std::size_t bytes() const noexcept { return vertices_.bytes + triangles_.bytes; }
  /// [bytes] uploaded since construction.
  std::size_t uploaded() const noexcept { return uploaded_; }

 private:
  struct Buffer {
    unsigned name = 0;
    std::size_t bytes = 0;
  };
  bool reserve(Buffer& buffer, unsigned target, std::size_t bytes, std::size_t spare);
  void upload(unsigned target, std::size_t offset, const void* data, std::size_t bytes);

  Buffer vertices_, triangles_;
  std::size_t uploaded_ = 0;
  std::shared_ptr<const SandSnapshot> sand_;  // what the buffers hold
};

}  // namespace teren
