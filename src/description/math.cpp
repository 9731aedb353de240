// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/description/math.hpp"

namespace vsa::description {
namespace {

constexpr double kSame = 1e-3, kSameInertia = 1e-6;

}  // namespace

Quat Quat::about(const Vec3& axis, double angle_rad) {
  const double square = axis.Dot(axis);
  if (square <= kNoLength) return {};
  const double half = angle_rad * 0.5, scale = std::sin(half) / std::sqrt(square);
  const double w = std::cos(half), x = axis.X() * scale, y = axis.Y() * scale, z = axis.Z() * scale;
  const double length = std::sqrt(w * w + x * x + y * y + z * z);
  return {w / length, x / length, y / length, z / length};
}

Quat Quat::Inverse() const {
  const double square = w_ * w_ + x_ * x_ + y_ * y_ + z_ * z_;
  if (square <= kNoLength) return {};
  return {w_ / square, -x_ / square, -y_ / square, -z_ / square};
}

Quat Quat::operator*(const Quat& q) const {
  return {w_ * q.w_ - x_ * q.x_ - y_ * q.y_ - z_ * q.z_, w_ * q.x_ + x_ * q.w_ + y_ * q.z_ - z_ * q.y_,
          w_ * q.y_ - x_ * q.z_ + y_ * q.w_ + z_ * q.x_, w_ * q.z_ + x_ * q.y_ - y_ * q.x_ + z_ * q.w_};
}

Vec3 Quat::operator*(const Vec3& v) const {
  const Vec3 axis(x_, y_, z_), across = axis.Cross(v), twice_across = axis.Cross(across);
  return v + across * (2 * w_) + twice_across * 2;
}

Pose3 Pose3::Inverse() const {
  const Quat back = q_.Inverse();
  return {back * (p_ * -1), back};
}

Pose3 Pose3::operator*(const Pose3& inner) const {
  // By quaternions, not as Quat * Vec3 has it: the two differ in their last bits, and worlds keep theirs.
  const Quat turned = q_ * (Quat(0, inner.p_.X(), inner.p_.Y(), inner.p_.Z()) * q_.Inverse());
  return {p_ + Vec3(turned.X(), turned.Y(), turned.Z()), q_ * inner.q_};
}

Vec3 Mat3::operator*(const Vec3& v) const {
  const Mat3& m = *this;
  return {m(0, 0) * v[0] + m(0, 1) * v[1] + m(0, 2) * v[2], m(1, 0) * v[0] + m(1, 1) * v[1] + m(1, 2) * v[2],
          m(2, 0) * v[0] + m(2, 1) * v[1] + m(2, 2) * v[2]};
}

Mat3 Mat3::Inverse() const {
  const Mat3& m = *this;
  const double a = m(2, 2) * m(1, 1) - m(2, 1) * m(1, 2), b = -(m(2, 2) * m(1, 0) - m(2, 0) * m(1, 2)),
               c = m(2, 1) * m(1, 0) - m(2, 0) * m(1, 1);
  const double s = 1.0 / (a * m(0, 0) + b * m(0, 1) + c * m(0, 2));
  return {s * a, s * -(m(2, 2) * m(0, 1) - m(2, 1) * m(0, 2)), s * (m(1, 2) * m(0, 1) - m(1, 1) * m(0, 2)),
          s * b, s * (m(2, 2) * m(0, 0) - m(2, 0) * m(0, 2)),  s * -(m(1, 2) * m(0, 0) - m(1, 0) * m(0, 2)),
          s * c, s * -(m(2, 1) * m(0, 0) - m(2, 0) * m(0, 1)), s * (m(1, 1) * m(0, 0) - m(1, 0) * m(0, 1))};
}

bool alike(const Vec3& a, const Vec3& b) {
  return std::abs(a.X() - b.X()) <= kSame && std::abs(a.Y() - b.Y()) <= kSame && std::abs(a.Z() - b.Z()) <= kSame;
}

bool alike(const Pose3& a, const Pose3& b) {
  const auto axis = [](const Quat& q) { return Vec3(q.X(), q.Y(), q.Z()); };
  return alike(a.Pos(), b.Pos()) && std::abs(a.Rot().W() - b.Rot().W()) <= kSame && alike(axis(a.Rot()), axis(b.Rot()));
}

bool alike(const Mat3& a, const Mat3& b) {
  for (std::size_t i = 0; i < 9; ++i) {
    if (!(std::abs(a(i / 3, i % 3) - b(i / 3, i % 3)) <= kSameInertia)) return false;
  }
  return true;
}

}  // namespace vsa::description
