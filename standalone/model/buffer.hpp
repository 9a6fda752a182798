// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_MODEL_BUFFER_HPP
#define SOLIDEM_MODEL_BUFFER_HPP

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>
#include <utility>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace solidem {

/// Writes zeros, in parts by the threads that will work on them: memory lies near the thread that
/// touches it first.
void fill_with_zeros(char* memory, std::size_t bytes);

/// Zeroed memory for a column, aligned to a cache line.
/// Large buffers ask for huge pages (worth a quarter of the run time at a million elements), and
/// each starts at another offset in its page: columns whose bases differ by multiples of 2 MiB
/// would compete for the same cache sets.
template <class T>
class Buffer {
 public:
  Buffer() = default;
  explicit Buffer(std::size_t size) { assign(size); }

  /// So many zeros, in the memory that is there if it is large enough.
  void assign(std::size_t size) {
    if (!memory_)
      allocate(size);
    else if (size > room_ || size < room_ / 2)
      allocate(size + size / 16);  // lists that change grow and shrink
    else
      fill_with_zeros(reinterpret_cast<char*>(data_), size * sizeof(T));
    size_ = size;
  }

  T* data() { return data_; }
  const T* data() const { return data_; }
  std::size_t size() const { return size_; }
  T& operator[](std::size_t k) { return data_[k]; }
  const T& operator[](std::size_t k) const { return data_[k]; }
  T* begin() { return data_; }
  T* end() { return data_ + size_; }
  const T* begin() const { return data_; }
  const T* end() const { return data_ + size_; }

 private:
  static constexpr std::size_t line = 64, huge_page = std::size_t{1} << 21;
  struct Free {
    void operator()(char* memory) const { std::free(memory); }
  };
  void allocate(std::size_t size) {
    static std::size_t stagger = 0;
    const std::size_t bytes = size * sizeof(T);
    const bool large = bytes >= huge_page;
    const std::size_t offset = large ? line * (1 + 9 * (stagger++ % 64)) : 0;
    const std::size_t alignment = large ? huge_page : line;
    const std::size_t whole = (bytes + offset + line) / alignment * alignment + alignment;
    memory_.reset(static_cast<char*>(std::aligned_alloc(alignment, whole)));
    if (!memory_) throw std::bad_alloc();
#if defined(__linux__)
    if (large) madvise(memory_.get(), whole, MADV_HUGEPAGE);
#endif
    fill_with_zeros(memory_.get(), offset + bytes);
    data_ = reinterpret_cast<T*>(memory_.get() + offset);
    room_ = size;
  }

  std::unique_ptr<char, Free> memory_;
  T* data_ = nullptr;
  std::size_t size_ = 0, room_ = 0;
};

}  // namespace solidem

#endif
