// SPDX-License-Identifier: GPL-2.0-or-later
//
// Vectors, quaternions and rotation matrices over any scalar: `double`, a SIMD pack, a dual number.
// A scalar needs + - * /, unary minus, and `sqrt`, `abs`, `exp` and `log` found by
// argument-dependent lookup; and, where a law decides, `greater`, `either`, `both`, `any` and
// `select` (of a pack: lane by lane).
#ifndef SOLIDEM_LAWS_ALGEBRA_HPP
#define SOLIDEM_LAWS_ALGEBRA_HPP

#include <cmath>

namespace solidem {

constexpr bool greater(double a, double b) {
  return a > b;
}
constexpr bool either(bool a, bool b) {
  return a || b;
}
constexpr bool both(bool a, bool b) {
  return a && b;
}
constexpr bool any(bool a) {
  return a;
}
/// a where the condition holds, else b.
constexpr double select(bool condition, double a, double b) {
  return condition ? a : b;
}

/// What is added to a square before a root, so that nothing is divided by zero: far below any
/// square that matters, and its inverse is finite.
inline constexpr double tiny_square = 1e-280;

/// A vector of three Cartesian components.
template <class Real>
struct Vector3 {
  Real x{}, y{}, z{};

  friend constexpr Vector3 operator+(const Vector3& a, const Vector3& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  friend constexpr Vector3 operator-(const Vector3& a, const Vector3& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  friend constexpr Vector3 operator-(const Vector3& a) { return {-a.x, -a.y, -a.z}; }
  friend constexpr Vector3 operator*(const Real& s, const Vector3& a) {
    return {s * a.x, s * a.y, s * a.z};
  }
  constexpr Vector3& operator+=(const Vector3& b) { return *this = *this + b; }
  constexpr Vector3& operator-=(const Vector3& b) { return *this = *this - b; }
};

/// The component along an axis: 0, 1, 2 for x, y, z.
template <class Real>
constexpr Real& component(Vector3<Real>& v, int axis) {
  return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}
template <class Real>
constexpr const Real& component(const Vector3<Real>& v, int axis) {
  return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

template <class Real>
constexpr Real dot(const Vector3<Real>& a, const Vector3<Real>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <class Real>
constexpr Vector3<Real> cross(const Vector3<Real>& a, const Vector3<Real>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

template <class Real>
Real norm(const Vector3<Real>& a) {
  using std::sqrt;
  return sqrt(dot(a, a));
}

/// One over a root. A scalar may have a quicker way, found by argument-dependent lookup.
template <class Real>
constexpr Real inverse_sqrt(const Real& a) {
  using std::sqrt;
  return Real{1.0} / sqrt(a);
}

/// A length and what one over it and over another is.
template <class Real>
struct LengthAndInverses {
  Real length, inverse, inverse_of_other;
};

/// Of the square of a length. One division, the slowest thing here, serves both inverses; a scalar
/// may have a quicker way, found by argument-dependent lookup.
template <class Real>
constexpr LengthAndInverses<Real> length_and_inverses(const Real& squared, const Real& other) {
  using std::sqrt;
  const Real length = sqrt(squared);
  const Real inverse_of_both = Real{1.0} / (length * other);
  return {length, inverse_of_both * other, inverse_of_both * length};
}

/// A quaternion w + v. A unit quaternion is the orientation of a body: it turns body axes into
/// world axes; q and −q are the same orientation.
template <class Real>
struct Quaternion {
  Real w{1.0};
  Vector3<Real> v{};
};

/// The conjugate; the inverse rotation of a unit quaternion.
template <class Real>
constexpr Quaternion<Real> conjugate(const Quaternion<Real>& q) {
  return {q.w, -q.v};
}

/// Hamilton's product: as rotations, first b, then a.
template <class Real>
constexpr Quaternion<Real> operator*(const Quaternion<Real>& a, const Quaternion<Real>& b) {
  return {a.w * b.w - dot(a.v, b.v), a.w * b.v + b.w * a.v + cross(a.v, b.v)};
}

/// A body vector in world axes, for a unit quaternion q.
template <class Real>
constexpr Vector3<Real> rotate(const Quaternion<Real>& q, const Vector3<Real>& body) {
  const Vector3<Real> t = cross(q.v, body);
  const Vector3<Real> s = q.w * t + cross(q.v, t);
  return body + s + s;
}

/// A world vector in body axes.
template <class Real>
constexpr Vector3<Real> rotate_back(const Quaternion<Real>& q, const Vector3<Real>& world) {
  return rotate(conjugate(q), world);
}

/// A rotation matrix by rows; cheaper than its quaternion when one orientation turns many vectors.
template <class Real>
struct Rotation {
  Vector3<Real> row_x, row_y, row_z;

  /// The matrix of a unit quaternion.
  explicit constexpr Rotation(const Quaternion<Real>& q) {
    const Vector3<Real> d = q.v + q.v;
    const Real xx = d.x * q.v.x, yy = d.y * q.v.y, zz = d.z * q.v.z;
    const Real xy = d.x * q.v.y, xz = d.x * q.v.z, yz = d.y * q.v.z;
    const Real wx = d.x * q.w, wy = d.y * q.w, wz = d.z * q.w;
    const Real one{1.0};
    row_x = {one - (yy + zz), xy - wz, xz + wy};
    row_y = {xy + wz, one - (xx + zz), yz - wx};
    row_z = {xz - wy, yz + wx, one - (xx + yy)};
  }
};

/// A body vector in world axes.
template <class Real>
constexpr Vector3<Real> rotate(const Rotation<Real>& rotation, const Vector3<Real>& body) {
  return {dot(rotation.row_x, body), dot(rotation.row_y, body), dot(rotation.row_z, body)};
}

/// A world vector in body axes.
template <class Real>
constexpr Vector3<Real> rotate_back(const Rotation<Real>& rotation, const Vector3<Real>& world) {
  return world.x * rotation.row_x + world.y * rotation.row_y + world.z * rotation.row_z;
}

}  // namespace solidem

#endif
