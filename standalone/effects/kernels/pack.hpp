// SPDX-License-Identifier: GPL-2.0-or-later
//
// A pack of doubles as wide as the instruction set this file is compiled for. Laws take it as their
// scalar. Everything here lives in a namespace of the instruction set, so that the linker never
// mixes code of two of them.
#ifndef SOLIDEM_EFFECTS_KERNELS_PACK_HPP
#define SOLIDEM_EFFECTS_KERNELS_PACK_HPP

#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "laws/algebra.hpp"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

#ifndef SOLIDEM_INSTRUCTION_SET
#define SOLIDEM_INSTRUCTION_SET baseline
#endif

namespace solidem::SOLIDEM_INSTRUCTION_SET {

#if defined(__AVX512F__)
inline constexpr int width = 8;
// The unmasked intrinsics read an undefined register, which g++ 12 warns of.
inline constexpr __mmask8 every_lane = 0xff;
inline constexpr __mmask8 upper_half = 0xf0;
#elif defined(__AVX__)
inline constexpr int width = 4;
#else
inline constexpr int width = 2;
#endif

typedef double Lanes __attribute__((vector_size(width * sizeof(double))));

/// Whether a pack can be read at an address at once, as in every column; processors refuse others.
inline bool is_aligned(const double* at) {
  return reinterpret_cast<std::uintptr_t>(at) % sizeof(Lanes) == 0;
}

/// `width` doubles, one in each lane. How it is copied is written out, so that what is made of
/// packs (a vector, a pose) is copied pack by pack, in registers; compilers move it through memory
/// in pieces else, and wait for each.
struct Pack {
  Lanes v;

  Pack() : v{} {}
  Pack(double s) : v(s - Lanes{}) {}  // NOLINT: a scalar is a pack of equals; s − 0 costs nothing
  explicit Pack(Lanes lanes) : v(lanes) {}
  Pack(const Pack& other) : v(other.v) {}
  Pack& operator=(const Pack& other) {
    v = other.v;
    return *this;
  }

  static Pack load(const double* from) {
    assert(is_aligned(from));
    return Pack(*reinterpret_cast<const Lanes*>(from));
  }
  void store(double* to) const {
    assert(is_aligned(to));
    *reinterpret_cast<Lanes*>(to) = v;
  }
  /// The same of an address that is no multiple of the width.
  static Pack load_anywhere(const double* from) {
    Pack pack;
    std::memcpy(&pack.v, from, sizeof pack.v);
    return pack;
  }

  friend Pack operator+(Pack a, Pack b) { return Pack(a.v + b.v); }
  friend Pack operator-(Pack a, Pack b) { return Pack(a.v - b.v); }
  friend Pack operator*(Pack a, Pack b) { return Pack(a.v * b.v); }
  friend Pack operator/(Pack a, Pack b) { return Pack(a.v / b.v); }
  friend Pack operator-(Pack a) { return Pack(-a.v); }
  Pack& operator+=(Pack b) { return *this = *this + b; }
};

inline Pack sqrt(Pack a) {
#if defined(__AVX512F__)
  return Pack(Lanes(_mm512_maskz_sqrt_pd(every_lane, a.v)));
#elif defined(__AVX__)
  return Pack(Lanes(_mm256_sqrt_pd(a.v)));
#elif defined(__x86_64__)
  return Pack(Lanes(_mm_sqrt_pd(a.v)));
#else
  Lanes r = a.v;
  for (int k = 0; k < width; ++k) r[k] = __builtin_sqrt(a.v[k]);
  return Pack(r);
#endif
}

/// 1/√a to a few units in the last place; of 0 infinity or no number.
inline Pack inverse_sqrt(Pack a) {
#if defined(__AVX512F__)
  // What the machine gives to 14 bits times the series of (1 − e)^(−1/2), e about 2^−13.
  const Pack y(Lanes(_mm512_maskz_rsqrt14_pd(every_lane, a.v)));
  const Pack e = Pack(1.0) - a * y * y;
  return y + y * e * (Pack(0.5) + e * (Pack(0.375) + e * Pack(0.3125)));
#else
  return Pack(1.0) / sqrt(a);
#endif
}

#if defined(__AVX512F__)
/// Without a root, and with a division that waits for nothing. The length is that of a root but for
/// a rare last bit: what is left of its square corrects it.
inline LengthAndInverses<Pack> length_and_inverses(const Pack& squared, const Pack& other) {
  const Pack inverse = inverse_sqrt(squared);
  const Pack length = squared * inverse;
  return {length + (squared - length * length) * (Pack(0.5) * inverse), inverse, Pack(1.0) / other};
}
#endif

/// Yes or no in each lane.
struct Mask {
#if defined(__AVX512F__)
  __mmask8 v;
#else
  typedef decltype(Lanes{} < Lanes{}) Answers;
  Answers v;
#endif
  bool operator[](int lane) const {
#if defined(__AVX512F__)
    return (v >> lane & 1) != 0;
#else
    return v[lane] != 0;
#endif
  }
};

inline Mask greater(Pack a, Pack b) {
#if defined(__AVX512F__)
  return {_mm512_cmp_pd_mask(a.v, b.v, _CMP_GT_OQ)};
#else
  return {a.v > b.v};
#endif
}

inline Mask either(Mask a, Mask b) {
#if defined(__AVX512F__)
  return {static_cast<__mmask8>(a.v | b.v)};
#else
  return {a.v | b.v};
#endif
}

/// Lanes of which a byte is not zero.
inline Mask is_set(const char* bytes) {
#if defined(__AVX512F__)
  const __m128i eight = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(bytes));
  return {static_cast<__mmask8>(_mm_test_epi8_mask(eight, eight))};
#else
  Mask set{};
  for (int k = 0; k < width; ++k) set.v[k] = bytes[k] != 0 ? -1 : 0;
  return set;
#endif
}

inline Mask both(Mask a, Mask b) {
#if defined(__AVX512F__)
  return {static_cast<__mmask8>(a.v & b.v)};
#else
  return {a.v & b.v};
#endif
}

inline Mask opposite(Mask a) {
#if defined(__AVX512F__)
  return {static_cast<__mmask8>(~a.v)};
#else
  return {~a.v};
#endif
}

/// Lanes that are not a number.
inline Mask is_nan(Pack a) {
#if defined(__AVX512F__)
  return {_mm512_cmp_pd_mask(a.v, a.v, _CMP_UNORD_Q)};
#else
  return {a.v != a.v};
#endif
}

/// Is there a lane that says yes?
inline bool any(Mask a) {
#if defined(__AVX512F__)
  return a.v != 0;
#elif defined(__AVX__)
  return _mm256_movemask_pd(reinterpret_cast<__m256d>(a.v)) != 0;
#elif defined(__x86_64__)
  return _mm_movemask_pd(reinterpret_cast<__m128d>(a.v)) != 0;
#else
  for (int k = 0; k < width; ++k)
    if (a[k]) return true;
  return false;
#endif
}

/// a where the condition holds, else b.
inline Pack select(Mask condition, Pack a, Pack b) {
#if defined(__AVX512F__)
  return Pack(Lanes(_mm512_mask_blend_pd(condition.v, b.v, a.v)));
#elif defined(__AVX__)
  return Pack(Lanes(_mm256_blendv_pd(b.v, a.v, reinterpret_cast<__m256d>(condition.v))));
#else
  typedef Mask::Answers Bits;
  return Pack(reinterpret_cast<Lanes>((reinterpret_cast<Bits>(a.v) & condition.v) |
                                      (reinterpret_cast<Bits>(b.v) & ~condition.v)));
#endif
}

/// a, or b in the lanes where the condition holds and b is larger.
inline Pack raise(Pack a, Mask condition, Pack b) {
#if defined(__AVX512F__)
  return Pack(Lanes(_mm512_mask_max_pd(a.v, condition.v, a.v, b.v)));
#else
  return select(both(condition, greater(b, a)), b, a);
#endif
}

inline Pack abs(Pack a) {
  return select(greater(Pack(0.0), a), -a, a);
}

/// Bits of the lanes as integers.
typedef std::uint64_t LaneBits __attribute__((vector_size(width * sizeof(std::uint64_t))));

inline LaneBits bits_of(Pack a) {
  return reinterpret_cast<LaneBits>(a.v);
}
inline Pack pack_of(LaneBits bits) {
  return Pack(reinterpret_cast<Lanes>(bits));
}

// ln 2 in two parts, of which the first has zeros at its end: an integer times it is exact.
inline constexpr double ln2_high = 6.93147180369123816490e-01, ln2_low = 1.90821492927058770002e-10;

/// e^a to about an ulp: a = k ln 2 + r, |r| <= ln 2 / 2, and the series of e^r. Above 709.4
/// infinity, below -708 zero.
inline Pack exp(Pack a) {
  // Added to a small number it leaves the nearest integer in the last bits.
  const Pack integers(6755399441055744.0);  // 1.5 * 2^52
  const Pack highest(709.4), lowest(-708.0);
  const Pack bounded = select(greater(a, highest), highest, select(greater(lowest, a), lowest, a));
  const Pack shifted = bounded * Pack(1.44269504088896340736) + integers;
  const Pack k = shifted - integers;
  const Pack r = (bounded - k * Pack(ln2_high)) - k * Pack(ln2_low);
  constexpr double inverse_factorial[] = {
      1.0 / 6227020800, 1.0 / 479001600, 1.0 / 39916800, 1.0 / 3628800, 1.0 / 362880, 1.0 / 40320,
      1.0 / 5040,       1.0 / 720,       1.0 / 120,      1.0 / 24,      1.0 / 6,      0.5};
  Pack series(inverse_factorial[0]);
  for (int n = 1; n < 12; ++n) series = series * r + Pack(inverse_factorial[n]);
  const Pack power = Pack(1.0) + (r + r * r * series);
  const Pack scale = pack_of((bits_of(shifted) << 52) + bits_of(Pack(1.0)));
  return select(greater(a, highest), Pack(HUGE_VAL),
                select(greater(lowest, a), Pack(0.0), power * scale));
}

/// Natural logarithm to about an ulp: a = 2^k m, m from sqrt(1/2) to sqrt(2), and the series of
/// 2 artanh((m - 1) / (m + 1)). Of 0 (and of what is too small to be normal) minus infinity, of a
/// negative number none.
inline Pack log(Pack a) {
  const LaneBits mantissa_bits = LaneBits{} + 0xfffffffffffffu;
  const LaneBits mantissa = bits_of(a) & mantissa_bits;
  Pack m = pack_of(mantissa | bits_of(Pack(1.0)));
  const Pack two52(4503599627370496.0);
  Pack k = pack_of((bits_of(a) >> 52) | bits_of(two52)) - two52 - Pack(1023.0);
  const Mask upper = greater(m, Pack(1.41421356237309504880));
  m = select(upper, Pack(0.5) * m, m);
  k = select(upper, k + Pack(1.0), k);
  const Pack s = (m - Pack(1.0)) / (m + Pack(1.0)), square = s * s;
  Pack series(1.0 / 23);
  for (int n = 21; n > 1; n -= 2) series = series * square + Pack(1.0 / n);
  const Pack twice = s + s;
  const Pack result = k * Pack(ln2_high) + (twice + (twice * square * series + k * Pack(ln2_low)));
  const Pack none = a - a;  // not a number where a is none or infinite
  const Pack special =
      select(greater(Pack(0.0), a), Pack(-HUGE_VAL) - Pack(-HUGE_VAL), Pack(-HUGE_VAL));
  const Mask is_normal = greater(a, Pack(2.2250738585072011e-308));
  const Pack usual = select(greater(a, Pack(1.7976931348623157e308)), a, result + none);
  return select(either(is_normal, is_nan(a)), usual, special);
}

/// table[index[k]] in lane k.
inline Pack gather(const double* table, const std::int32_t* index) {
#if defined(__AVX512F__)
  const __m256i at = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(index));
  return Pack(Lanes(_mm512_mask_i32gather_pd(_mm512_setzero_pd(), every_lane, at, table, 8)));
#else
  Lanes r{};
  for (int k = 0; k < width; ++k) r[k] = table[index[k]];
  return Pack(r);
#endif
}

/// The opposite: lane k goes to table[index[k]].
inline void scatter(Pack values, double* table, const std::int32_t* index) {
  for (int k = 0; k < width; ++k) table[index[k]] = values.v[k];
}

/// Writes `first` + k for each lane k that says yes; returns how many. Behind them as many numbers
/// as a pack has lanes may be overwritten.
inline std::size_t write_numbers(Mask chosen, std::size_t first, std::uint32_t* to) {
#if defined(__AVX512F__)
  const __m256i number = _mm256_add_epi32(_mm256_set1_epi32(static_cast<int>(first)),
                                          _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7));
  _mm256_mask_compressstoreu_epi32(to, chosen.v, number);
  return static_cast<std::size_t>(__builtin_popcount(chosen.v));
#else
  std::size_t count = 0;
  for (int k = 0; k < width; ++k) {
    to[count] = static_cast<std::uint32_t>(first) + static_cast<std::uint32_t>(k);
    count += chosen[k] ? 1 : 0;
  }
  return count;
#endif
}

/// Turns a square of packs over its diagonal.
inline void transpose(Pack (&p)[width]) {
#if defined(__AVX512F__)
  Lanes a[8], b[8];
  for (int k = 0; k < 8; k += 2) {
    a[k] = __builtin_shufflevector(p[k].v, p[k + 1].v, 0, 8, 2, 10, 4, 12, 6, 14);
    a[k + 1] = __builtin_shufflevector(p[k].v, p[k + 1].v, 1, 9, 3, 11, 5, 13, 7, 15);
  }
  for (int k = 0; k < 8; k += 4)
    for (int h = 0; h < 2; ++h) {
      b[k + h] = __builtin_shufflevector(a[k + h], a[k + h + 2], 0, 1, 8, 9, 4, 5, 12, 13);
      b[k + h + 2] = __builtin_shufflevector(a[k + h], a[k + h + 2], 2, 3, 10, 11, 6, 7, 14, 15);
    }
  for (int k = 0; k < 4; ++k) {
    p[k].v = __builtin_shufflevector(b[k], b[k + 4], 0, 1, 2, 3, 8, 9, 10, 11);
    p[k + 4].v = __builtin_shufflevector(b[k], b[k + 4], 4, 5, 6, 7, 12, 13, 14, 15);
  }
#elif defined(__AVX__)
  const Lanes a0 = __builtin_shufflevector(p[0].v, p[1].v, 0, 4, 2, 6);
  const Lanes a1 = __builtin_shufflevector(p[0].v, p[1].v, 1, 5, 3, 7);
  const Lanes a2 = __builtin_shufflevector(p[2].v, p[3].v, 0, 4, 2, 6);
  const Lanes a3 = __builtin_shufflevector(p[2].v, p[3].v, 1, 5, 3, 7);
  p[0].v = __builtin_shufflevector(a0, a2, 0, 1, 4, 5);
  p[1].v = __builtin_shufflevector(a1, a3, 0, 1, 4, 5);
  p[2].v = __builtin_shufflevector(a0, a2, 2, 3, 6, 7);
  p[3].v = __builtin_shufflevector(a1, a3, 2, 3, 6, 7);
#else
  const Lanes a0 = __builtin_shufflevector(p[0].v, p[1].v, 0, 2);
  const Lanes a1 = __builtin_shufflevector(p[0].v, p[1].v, 1, 3);
  p[0].v = a0;
  p[1].v = a1;
#endif
}

/// Four components of `width` elements, whose rows of four doubles, or the first four of longer
/// ones, stand anywhere.
struct Quad {
  Pack component[4];

  template <int row_length = 4>
  static Quad gather(const double* rows, const std::int32_t* index) {
    const auto row = [&](int k) { return rows + std::ptrdiff_t{row_length} * index[k]; };
    Quad quad;
#if defined(__AVX512F__)
    Lanes a[4];  // rows k and k + 4
    for (int k = 0; k < 4; ++k)
      a[k] = Lanes(_mm512_mask_broadcast_f64x4(_mm512_castpd256_pd512(_mm256_load_pd(row(k))),
                                               upper_half, _mm256_load_pd(row(k + 4))));
    const Lanes b0 = __builtin_shufflevector(a[0], a[1], 0, 8, 2, 10, 4, 12, 6, 14);
    const Lanes b1 = __builtin_shufflevector(a[0], a[1], 1, 9, 3, 11, 5, 13, 7, 15);
    const Lanes b2 = __builtin_shufflevector(a[2], a[3], 0, 8, 2, 10, 4, 12, 6, 14);
    const Lanes b3 = __builtin_shufflevector(a[2], a[3], 1, 9, 3, 11, 5, 13, 7, 15);
    quad.component[0].v = __builtin_shufflevector(b0, b2, 0, 1, 8, 9, 4, 5, 12, 13);
    quad.component[1].v = __builtin_shufflevector(b1, b3, 0, 1, 8, 9, 4, 5, 12, 13);
    quad.component[2].v = __builtin_shufflevector(b0, b2, 2, 3, 10, 11, 6, 7, 14, 15);
    quad.component[3].v = __builtin_shufflevector(b1, b3, 2, 3, 10, 11, 6, 7, 14, 15);
#else
    for (int part = 0; part < 4; part += width) {
      Pack square[width];
      for (int k = 0; k < width; ++k) square[k] = Pack::load(row(k) + part);
      transpose(square);
      for (int k = 0; k < width; ++k) quad.component[part + k] = square[k];
    }
#endif
    return quad;
  }

  /// The same for rows that follow one another.
  template <int row_length = 4>
  static Quad load(const double* rows) {
    std::int32_t index[width];
    for (int k = 0; k < width; ++k) index[k] = k;
    return gather<row_length>(rows, index);
  }

  void store(double* rows) const {
#if defined(__AVX512F__)
    const Lanes x = component[0].v, y = component[1].v, z = component[2].v, w = component[3].v;
    const Lanes xy_even = __builtin_shufflevector(x, y, 0, 8, 2, 10, 4, 12, 6, 14);
    const Lanes xy_odd = __builtin_shufflevector(x, y, 1, 9, 3, 11, 5, 13, 7, 15);
    const Lanes zw_even = __builtin_shufflevector(z, w, 0, 8, 2, 10, 4, 12, 6, 14);
    const Lanes zw_odd = __builtin_shufflevector(z, w, 1, 9, 3, 11, 5, 13, 7, 15);
    const Lanes rows04 = __builtin_shufflevector(xy_even, zw_even, 0, 1, 8, 9, 4, 5, 12, 13);
    const Lanes rows26 = __builtin_shufflevector(xy_even, zw_even, 2, 3, 10, 11, 6, 7, 14, 15);
    const Lanes rows15 = __builtin_shufflevector(xy_odd, zw_odd, 0, 1, 8, 9, 4, 5, 12, 13);
    const Lanes rows37 = __builtin_shufflevector(xy_odd, zw_odd, 2, 3, 10, 11, 6, 7, 14, 15);
    Pack(__builtin_shufflevector(rows04, rows15, 0, 1, 2, 3, 8, 9, 10, 11)).store(rows);
    Pack(__builtin_shufflevector(rows26, rows37, 0, 1, 2, 3, 8, 9, 10, 11)).store(rows + 8);
    Pack(__builtin_shufflevector(rows04, rows15, 4, 5, 6, 7, 12, 13, 14, 15)).store(rows + 16);
    Pack(__builtin_shufflevector(rows26, rows37, 4, 5, 6, 7, 12, 13, 14, 15)).store(rows + 24);
#else
    for (int part = 0; part < 4; part += width) {
      Pack square[width];
      for (int k = 0; k < width; ++k) square[k] = component[part + k];
      transpose(square);
      for (int k = 0; k < width; ++k) square[k].store(rows + 4 * k + part);
    }
#endif
  }
};

/// Eight components of `width` elements, whose rows of eight doubles stand anywhere.
struct Row {
  Pack component[8];

  static Row gather(const double* rows, const std::int32_t* index) {
    Row row;
    for (int part = 0; part < 8; part += width) {
      Pack square[width];
      for (int k = 0; k < width; ++k)
        square[k] = Pack::load(rows + std::ptrdiff_t{8} * index[k] + part);
      transpose(square);
      for (int k = 0; k < width; ++k) row.component[part + k] = square[k];
    }
    return row;
  }

  /// The same for rows that follow one another.
  static Row load(const double* rows) {
    std::int32_t index[width];
    for (int k = 0; k < width; ++k) index[k] = k;
    return gather(rows, index);
  }

  /// The opposite of gather().
  void scatter(double* rows, const std::int32_t* index) const {
    for (int part = 0; part < 8; part += width) {
      Pack square[width];
      for (int k = 0; k < width; ++k) square[k] = component[part + k];
      transpose(square);
      for (int k = 0; k < width; ++k) square[k].store(rows + std::ptrdiff_t{8} * index[k] + part);
    }
  }

  void store(double* rows) const {
    std::int32_t index[width];
    for (int k = 0; k < width; ++k) index[k] = k;
    scatter(rows, index);
  }
};

/// Far enough ahead for a neighbour's line to arrive, near enough to be still there.
inline constexpr std::size_t rows_ahead = 4;

/// Asks for the lines of rows that a pack will gather soon.
template <int row_length>
inline void prefetch_rows(const double* rows, const std::int32_t* index) {
  for (int k = 0; k < width; ++k) __builtin_prefetch(rows + std::ptrdiff_t{row_length} * index[k]);
}

}  // namespace solidem::SOLIDEM_INSTRUCTION_SET

#endif
