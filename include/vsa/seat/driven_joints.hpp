// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Which joints of this process have a robot. Two robots on one joint (a <plugin> given twice, a nested model's joint driven from
// inside and from outside) would add their torques, and both would be wrong: the second is refused.
#pragma once

#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

namespace vsa::seat {

/// A joint among all that live in this process, as its host tells it apart. Not its name: of two models of one name, one may be on
/// its way out.
struct JointKey {
  const void* world = nullptr;  ///< Classic: the World; gz-sim: the EntityComponentManager
  std::uint64_t joint = 0;      ///< Classic: Base::GetId(); gz-sim: the entity
  friend bool operator<(const JointKey& a, const JointKey& b) noexcept {
    return std::tie(a.world, a.joint) < std::tie(b.world, b.joint);
  }
};

/// The joints of one robot, taken for as long as it lives. Safe from several threads.
class DrivenJoints {
 public:
  /// A joint to take, with what the refusal of a second robot calls it.
  struct Joint {
    JointKey key;          ///< by which it is known; its name only goes into messages
    std::string name;      ///< relative to the model
    std::string actuator;  ///< that drives it
  };

  /// Takes all of them or none. Throws InputError with every joint that another robot of this process drives; `owner` ("world:
  /// model") leads its lines, and is what later ones are told.
  DrivenJoints(std::string owner, const std::vector<Joint>& joints);
  ~DrivenJoints();  ///< gives them back
  DrivenJoints(const DrivenJoints&) = delete;
  DrivenJoints& operator=(const DrivenJoints&) = delete;

 private:
  std::vector<JointKey> mine_;
};

}  // namespace vsa::seat
