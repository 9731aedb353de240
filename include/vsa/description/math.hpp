// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Vectors, rotations and poses, as much as a description and who reads or simulates one need. They take those of the Gazebo
// libraries, whatever namespace these have (anything with X(), Y(), Z(), with W() besides, or with Pos() and Rot()), so that only a
// reader of SDF needs such a library. Sums stand in the order of ignition-math 6: worlds kept their bits when it left.
//
// Rotations are quaternions w + xi + yj + zk; p = q·v·q⁻¹. A quaternion shorter than 1e-3 has the identity for its inverse.
#pragma once

#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>

namespace vsa::description {

/// A vector of the Gazebo libraries, or one of ours.
template <class T>
concept HasXyz = requires(const T& t) {
  { t.X() } -> std::convertible_to<double>;
  { t.Y() } -> std::convertible_to<double>;
  { t.Z() } -> std::convertible_to<double>;
};
/// A quaternion, likewise.
template <class T>
concept HasWxyz = HasXyz<T> && requires(const T& t) {
  { t.W() } -> std::convertible_to<double>;
};
/// A pose, likewise.
template <class T>
concept HasPlace = requires(const T& t) {
  { t.Pos() } -> HasXyz;
  { t.Rot() } -> HasWxyz;
};

inline constexpr double kNoLength = 1e-6;  ///< a length, or of a quaternion its square, that counts as none

// NOLINTBEGIN(readability-identifier-naming): named as the Gazebo libraries name them, so that a reader may work with either
/// A vector: a place or direction in space, m unless its owner says otherwise.
class Vec3 {
 public:
  constexpr Vec3() = default;
  constexpr Vec3(double x, double y, double z) : v_{x, y, z} {}  ///< along the three axes
  /// Of any vector of the Gazebo libraries.
  template <HasXyz T>
  requires(!HasWxyz<T>) Vec3(const T& v) : v_{v.X(), v.Y(), v.Z()} {}  // NOLINT(google-explicit-constructor): see above

  [[nodiscard]] constexpr double X() const { return v_[0]; }                        ///< along x
  [[nodiscard]] constexpr double Y() const { return v_[1]; }                        ///< along y
  [[nodiscard]] constexpr double Z() const { return v_[2]; }                        ///< along z
  [[nodiscard]] constexpr double operator[](std::size_t i) const { return v_[i]; }  ///< 0 … 2, unchecked
  [[nodiscard]] constexpr double& operator[](std::size_t i) { return v_[i]; }       ///< 0 … 2, unchecked

  Vec3& operator+=(const Vec3& o) { return *this = *this + o; }  ///< coordinate by coordinate, as all of these
  Vec3& operator*=(double s) { return *this = *this * s; }
  [[nodiscard]] constexpr Vec3 operator-() const { return {-v_[0], -v_[1], -v_[2]}; }
  [[nodiscard]] friend constexpr Vec3 operator+(const Vec3& a, const Vec3& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
  [[nodiscard]] friend constexpr Vec3 operator-(const Vec3& a, const Vec3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
  /// Coordinate by coordinate: no dot product.
  [[nodiscard]] friend constexpr Vec3 operator*(const Vec3& a, const Vec3& b) { return {a[0] * b[0], a[1] * b[1], a[2] * b[2]}; }
  [[nodiscard]] friend constexpr Vec3 operator*(const Vec3& a, double s) { return {a[0] * s, a[1] * s, a[2] * s}; }
  [[nodiscard]] friend constexpr Vec3 operator/(const Vec3& a, double s) { return {a[0] / s, a[1] / s, a[2] / s}; }

  [[nodiscard]] constexpr bool operator==(const Vec3&) const = default;

  [[nodiscard]] constexpr double Dot(const Vec3& o) const { return v_[0] * o[0] + v_[1] * o[1] + v_[2] * o[2]; }  ///< a·b
  /// a × b.
  [[nodiscard]] constexpr Vec3 Cross(const Vec3& o) const {
    return {v_[1] * o[2] - v_[2] * o[1], v_[2] * o[0] - v_[0] * o[2], v_[0] * o[1] - v_[1] * o[0]};
  }
  [[nodiscard]] double Length() const { return std::sqrt(Dot(*this)); }  ///< |v|
  /// One shorter than kNoLength stays as it is.
  [[nodiscard]] Vec3 Normalized() const { return std::abs(Length()) <= kNoLength ? *this : *this / Length(); }
  /// No coordinate is NaN or infinite.
  [[nodiscard]] bool IsFinite() const { return std::isfinite(v_[0]) && std::isfinite(v_[1]) && std::isfinite(v_[2]); }
  /// Each coordinate the smaller of the two.
  void Min(const Vec3& o) {
    for (std::size_t i = 0; i < 3; ++i) v_[i] = o[i] < v_[i] ? o[i] : v_[i];
  }
  /// Each coordinate the larger of the two.
  void Max(const Vec3& o) {
    for (std::size_t i = 0; i < 3; ++i) v_[i] = o[i] > v_[i] ? o[i] : v_[i];
  }

  static const Vec3 Zero,  ///< (0, 0, 0)
      One;                 ///< (1, 1, 1)

 private:
  std::array<double, 3> v_{};
};
inline constexpr Vec3 Vec3::Zero{0, 0, 0}, Vec3::One{1, 1, 1};

/// A rotation as a quaternion w + xi + yj + zk: p = q·v·q⁻¹.
class Quat {
 public:
  constexpr Quat() = default;
  constexpr Quat(double w, double x, double y, double z) : w_(w), x_(x), y_(y), z_(z) {}  ///< unchecked: its length is the caller's
  /// Of any quaternion of the Gazebo libraries.
  template <HasWxyz T>
  Quat(const T& q) : w_(q.W()), x_(q.X()), y_(q.Y()), z_(q.Z()) {}      // NOLINT(google-explicit-constructor): see above
  [[nodiscard]] static Quat about(const Vec3& axis, double angle_rad);  ///< an axis of no length: no turn

  [[nodiscard]] constexpr double W() const { return w_; }  ///< cos of half the angle
  [[nodiscard]] constexpr double X() const { return x_; }  ///< along x, times sin of half the angle
  [[nodiscard]] constexpr double Y() const { return y_; }  ///< along y, likewise
  [[nodiscard]] constexpr double Z() const { return z_; }  ///< along z, likewise

  [[nodiscard]] Quat Inverse() const;                 ///< the turn back; of one shorter than 1e-3 the identity
  [[nodiscard]] Quat operator*(const Quat& q) const;  ///< first `q`, then this one
  [[nodiscard]] Vec3 operator*(const Vec3& v) const;  ///< `v`, turned

 private:
  double w_ = 1, x_ = 0, y_ = 0, z_ = 0;
};

/// A frame's place and rotation in another frame.
class Pose3 {
 public:
  Pose3() = default;
  Pose3(const Vec3& position, const Quat& rotation) : p_(position), q_(rotation) {}  ///< the frame's origin, and its axes turned
  /// Of any pose of the Gazebo libraries.
  template <HasPlace T>
  Pose3(const T& p) : p_(p.Pos()), q_(p.Rot()) {}  // NOLINT(google-explicit-constructor): see above

  [[nodiscard]] const Vec3& Pos() const { return p_; }  ///< of the origin
  [[nodiscard]] const Quat& Rot() const { return q_; }  ///< of the axes
  [[nodiscard]] Vec3& Pos() { return p_; }              ///< of the origin
  [[nodiscard]] Quat& Rot() { return q_; }              ///< of the axes
  [[nodiscard]] Pose3 Inverse() const;                  ///< the outer frame in this one
  /// `inner`, given in this pose's frame, in the frame that this one is given in.
  [[nodiscard]] Pose3 operator*(const Pose3& inner) const;

 private:
  Vec3 p_;
  Quat q_;
};

/// A 3 × 3 matrix by rows, as inertias need it.
class Mat3 {
 public:
  constexpr Mat3() = default;
  /// By rows.
  constexpr Mat3(double a, double b, double c, double d, double e, double f, double g, double h, double i)
      : m_{a, b, c, d, e, f, g, h, i} {}
  /// Any 3 × 3 of the Gazebo libraries.
  template <class T>
  requires(!std::same_as<T, Mat3> &&
           requires(const T& t) {
             { t(0, 0) } -> std::convertible_to<double>;
           }) Mat3(const T& m)  // NOLINT(google-explicit-constructor): see above
      : m_{m(0, 0), m(0, 1), m(0, 2), m(1, 0), m(1, 1), m(1, 2), m(2, 0), m(2, 1), m(2, 2)} {}

  /// 0 … 2 each, unchecked.
  [[nodiscard]] constexpr double operator()(std::size_t row, std::size_t column) const { return m_[3 * row + column]; }
  /// 0 … 2 each, unchecked.
  [[nodiscard]] constexpr double& operator()(std::size_t row, std::size_t column) { return m_[3 * row + column]; }
  [[nodiscard]] Vec3 operator*(const Vec3& v) const;  ///< of its rows with `v`
  [[nodiscard]] Mat3 Inverse() const;                 ///< of a singular one not finite

 private:
  std::array<double, 9> m_{};
};

// NOLINTEND(readability-identifier-naming)

/// The same but for what files round: numbers to 1e-3, inertias to 1e-6.
[[nodiscard]] bool alike(const Vec3& a, const Vec3& b);
[[nodiscard]] bool alike(const Pose3& a, const Pose3& b);  ///< both parts
[[nodiscard]] bool alike(const Mat3& a, const Mat3& b);    ///< entry by entry

}  // namespace vsa::description
