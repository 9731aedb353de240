// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Links, joints and contacts of a world, and what pulls at them.
#include <cstddef>

#include "arrays.hpp"
#include "world.hpp"

namespace vsa::python {
namespace {

static_assert(sizeof(scene::Pose) == 7 * sizeof(double));

py::dtype contact_dtype() {
  return record_dtype({{"position_m", offsetof(scene::Contact, position), 3},
                       {"force_N", offsetof(scene::Contact, force_N), 3},
                       {"link", offsetof(scene::Contact, link), 1, "u8"},
                       {"other", offsetof(scene::Contact, other), 1, "u8"}},
                      sizeof(scene::Contact));
}

py::array contacts(PyWorld& w) {
  std::vector<scene::Contact> now;
  w.get().contacts(now);
  return py::array(contact_dtype(), {static_cast<py::ssize_t>(now.size())}, now.data());
}

py::array poses(PyWorld& w, const py::object& out) {
  const std::size_t n = w.any_thread().links().size();
  py::array to = into(out, float64(), {static_cast<py::ssize_t>(n), 7});
  w.get().poses({static_cast<scene::Pose*>(to.mutable_data()), n});
  return to;
}

py::array pose(PyWorld& w, const std::string& link) {
  const engine::World& world = w.get();
  const scene::Pose p = world.pose(world.link(link));
  return copied({p.position[0], p.position[1], p.position[2], p.quaternion[0], p.quaternion[1], p.quaternion[2], p.quaternion[3]});
}

py::array velocity(PyWorld& w, const std::string& link) {
  const engine::World& world = w.get();
  const scene::Twist v = world.velocity(world.link(link));
  return copied({v.linear_m_per_s[0], v.linear_m_per_s[1], v.linear_m_per_s[2], v.angular_rad_per_s[0], v.angular_rad_per_s[1],
                 v.angular_rad_per_s[2]});
}

py::list link_info(PyWorld& w) {
  py::list out;
  for (const scene::LinkInfo& l : w.any_thread().links()) {
    out.append(py::dict(py::arg("name") = l.name, py::arg("model") = l.model, py::arg("mass_kg") = l.mass_kg,
                        py::arg("is_static") = l.is_static));
  }
  return out;
}

template <class Read>
py::array of_joints(PyWorld& w, const py::object& out, const Read& read) {
  py::array to = into(out, float64(), {static_cast<py::ssize_t>(w.joints().size())});
  const engine::World& world = w.get();
  auto* values = static_cast<double*>(to.mutable_data());
  for (std::size_t i = 0; i < w.joints().size(); ++i) values[i] = read(world, w.joints()[i]);
  return to;
}

py::array joint_angles(PyWorld& w, const py::object& out) {
  return of_joints(w, out, [](const engine::World& world, engine::JointHandle j) { return world.joint_angle(j); });
}

py::array joint_speeds(PyWorld& w, const py::object& out) {
  return of_joints(w, out, [](const engine::World& world, engine::JointHandle j) { return world.joint_speed(j); });
}

py::list joint_info(PyWorld& w) {
  constexpr std::array<const char*, 5> kTypes{"fixed", "revolute", "prismatic", "ball", "universal"};
  py::list out;
  for (const engine::JointInfo& j : w.any_thread().joints()) {
    py::dict one;
    one["name"] = j.name;
    one["type"] = kTypes[static_cast<std::size_t>(j.type)];
    one["range"] = j.range ? py::object(py::make_tuple((*j.range)[0], (*j.range)[1])) : py::none();
    one["actuator"] = j.actuator ? py::object(py::str(w.actuator_names()[*j.actuator])) : py::none();
    one["dof"] = py::cast(j.dof);
    one["damping"] = j.damping;
    one["stiffness"] = j.stiffness;
    one["rest"] = j.rest;
    one["dry_friction"] = j.dry_friction;
    one["follows"] = j.follows ? py::object(py::str(w.any_thread().joints()[*j.follows].name)) : py::none();
    one["held"] = j.held;
    one["pulled"] = j.pulled;
    one["closes_loop"] = j.closes_loop;
    out.append(one);
  }
  return out;
}

/// A pull whose link is known by name until a world takes it.
struct PyPull {
  std::string link;
  scene::Pull pull;
};

PyPull make_pull(const std::string& link, const py::object& target, const py::object& point, double stiffness, double damping,
                 double force_max) {
  return {link, {0, numbers<3>(point, "point_m"), numbers<3>(target, "target_m"), stiffness, damping, force_max}};
}

void pull(PyWorld& w, const py::args& hands) {
  const engine::World& world = w.any_thread();
  std::vector<scene::Pull> pulls;
  for (const auto& given : hands) {
    if (!py::isinstance<PyPull>(given)) throw py::type_error("pull: takes vsasim.Pull only");
    const auto& hand = py::cast<const PyPull&>(given);
    pulls.push_back(hand.pull);
    pulls.back().link = world.link(hand.link).index();
  }
  w.get().pull(std::move(pulls));
}

void bind_links(WorldClass& c) {
  c.def_property_readonly(
       "links",
       [](PyWorld& w) {
         std::vector<std::string> out;
         for (const scene::LinkInfo& l : w.any_thread().links()) out.push_back(l.name);
         return out;
       },
       "Scoped names of the links, \"model::link\": list of str.")
      .def("link_info", &link_info, "What is known of each link: list of dicts of name, model, mass_kg, is_static.")
      .def("poses", &poses, py::arg("out") = py::none(),
           "Poses of all links in the world: ndarray (links, 7), x y z in m and the quaternion w x y z. out: such an array, which "
           "is\n"
           "filled and returned. A copy either way.")
      .def("pose", &pose, py::arg("link"), "One link's pose: ndarray (7,), as a row of poses().")
      .def("velocity", &velocity, py::arg("link"),
           "A link's velocity: ndarray (6,), of its origin in m/s and angular in rad/s, both in world axes.")
      .def(
          "center_of_mass", [](PyWorld& w, const std::string& model) { return py::array(py::cast(w.get().center_of_mass(model))); },
          py::arg("model"), "A model's centre of mass in the world, m: ndarray (3,).")
      .def("contacts", &contacts,
           "The contacts that the last step worked with: structured ndarray (k,) of position_m (3), force_N (3) on `link` by "
           "`other`,\n"
           "both indices into `links`. None before the first step. A copy.");
}

void bind_joints(WorldClass& c) {
  c.def_property_readonly("joints", &PyWorld::joint_names,
                          "Scoped names of the joints with one axis, \"model::joint\": list of str.")
      .def("joint_info", &joint_info,
           "All joints, those without or with several axes too: list of dicts of name, type, range (rad or m; None: no limits),\n"
           "actuator (name or None) and dof (first degree of freedom, or None); of one axis also what the file gives the joint "
           "besides,\n"
           "damping, stiffness about rest, dry_friction (N·m, rad, s), and follows (the joint that it follows, or None). held and "
           "pulled: what\n"
           "else holds it (\"weld of arm and world\", \"the loop that m::j closes\") or acts on it (\"tendon t\"), lists of str.\n"
           "closes_loop: a constraint holds its links together; it has no angle and isn't among `joints`.")
      .def("joint_angles", &joint_angles, py::arg("out") = py::none(),
           "Angles (rad; m of a prismatic one) of `joints`: ndarray (joints,). out: such an array, which is filled and returned. A "
           "copy\n"
           "either way.")
      .def("joint_speeds", &joint_speeds, py::arg("out") = py::none(),
           "Their speeds, rad/s or m/s: ndarray (joints,). As joint_angles.")
      .def(
          "set_joint",
          [](PyWorld& w, const std::string& joint, double angle, double speed) { w.get().set_joint(joint, angle, speed); },
          py::arg("joint"), py::arg("angle_rad"), py::arg("speed_rad_per_s") = 0.0,
          "Sets a joint's angle and speed, and those of joints that follow it (<mimic> or <equality>); its actuator stays behind, "
          "which is a "
          "kick.\n"
          "place() moves that along. Its kinematic loops go along as in place(); where they don't, the joint alone is set and the\n"
          "constraint pulls the loop together, so that all its joints may be set one by one. InputError: beyond the joint's "
          "limits,\n"
          "and a follower elsewhere than its leader has it.")
      .def(
          "displace_model",
          [](PyWorld& w, const std::string& model, double yaw, const py::object& translation) {
            const auto by = numbers<3>(translation, "translation_m");
            w.get().displace_model(model, yaw, by);
          },
          py::arg("model"), py::arg("yaw_rad"), py::arg("translation_m"),
          "Moves a model that isn't fixed: adds a yaw about the world's z axis and a translation (3,) in m.");
}

}  // namespace

void bind_world_bodies(py::module_& m, WorldClass& c) {
  bind_links(c);
  bind_joints(c);
  py::class_<PyPull>(m, "Pull", "A spring from a point of a link to a place in the world, as a hand pulls; see World.pull.")
      .def(py::init(&make_pull), py::arg("link"), py::arg("target_m"), py::arg("point_m") = py::make_tuple(0, 0, 0),
           py::arg("stiffness_N_per_m") = 100.0, py::arg("damping_Ns_per_m") = 5.0, py::arg("force_max_N") = 20.0,
           "link: scoped name; target_m: (3,) in the world; point_m: (3,) in the link's frame; force_max_N: never more than that.")
      .def_readonly("link", &PyPull::link, "The link's name: str.");
  c.def(
      "pull", &pull,
      "pull(*hands): from the next step on these vsasim.Pull act, and no others; none lets go. No part of the state: reset() lets\n"
      "go, restore() doesn't. InputError: an unknown or static link, numbers out of range.");
}

}  // namespace vsa::python
