// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// From MuJoCo's model of a file to links and joints, with the names, the order and the bodies' looks that the file beside it gives.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "physics/mujoco/mjcf_file.hpp"
#include "physics/mujoco/versions.hpp"
#include "vsa/scoped_name.hpp"

namespace vsa::physics {
namespace {

using Kind = Joint::Kind;

std::string name_of(const mjModel& m, int type, int id) {
  const char* name = mj_id2name(&m, type, id);
  return name == nullptr ? "" : name;
}

class Describer {
 public:
  Describer(const mjModel& m, const std::string& file, const Beside& beside, description::World& out, LinkObjects& objects,
            Problems& problems)
      : m_(m),
        file_(file),
        beside_(beside),
        out_(out),
        objects_(objects),
        problems_(problems),
        data_(mj_makeData(&m)),
        link_of_body_(static_cast<std::size_t>(m.nbody)) {
    mj_kinematics(&m_, data_.get());
  }

  void all() {
    beside_.links.empty() ? links_of_bodies() : links_as_told();
    if (!problems_.empty()) return;
    geoms();
    frictions();
    beside_.joints.empty() ? joints_of_bodies() : joints_as_told();
    couplings();
    describe_forces(m_, objects_, out_);
  }

 private:
  void problem(std::string key, std::string value, std::string message, std::string allowed) {
    problems_.add({file_, std::move(key), std::move(value), std::move(message), std::move(allowed)});
  }
  [[nodiscard]] std::string scoped(const std::string& name) const {
    if (name.find("::") == std::string::npos) return scoped_name(out_.name, name);
    return scoped_name(speakable(std::string(scope_of(name))), name_within(name));
  }
  /// The file's names of its bodies or joints, each of which must be one's own; what has none is called "body_3", or, where somebody
  /// is called so, "body_3_", and so on.
  template <class Counts>
  [[nodiscard]] std::vector<std::string> names_of(int type, int count, const char* kind, Counts&& counts) {
    std::map<std::string, std::string> taken;  // by whom of the file
    std::vector<std::string> out;
    for (int id = 0; id < count; ++id) {
      const std::string own = counts(id) ? name_of(m_, type, id) : "";
      out.push_back(own.empty() ? "" : scoped(own));
      if (own.empty()) continue;
      if (const auto [at, is_new] = taken.emplace(out.back(), own); !is_new)
        problem(kind, out.back(), fmt::format("is there twice: \"{}\" and \"{}\" are both called so here", at->second, own),
                "names of their own");
    }
    for (int id = 0; id < count; ++id) {
      std::string& name = out[static_cast<std::size_t>(id)];
      if (!name.empty()) continue;
      name = scoped(fmt::format("{}_{}", kind, id));
      while (!taken.emplace(name, "").second) name += '_';
    }
    return out;
  }
  [[nodiscard]] Vec3 vector(const mjtNum* v) const { return {v[0], v[1], v[2]}; }

  void add_link(int body, scene::LinkInfo info, bool weightless = false) {
    Link link;
    const mjtNum *p = data_->xpos + 3 * body, *q = data_->xquat + 4 * body, *own = m_.body_inertia + 3 * body,
                 *turn = m_.body_iquat + 4 * body;
    if (!info.is_static) info.mass_kg = m_.body_mass[body];
    link.name = info.name;
    link.model = info.model;
    link.is_static = info.is_static;
    link.weightless = weightless;
    link.mass = info.mass_kg;
    link.pose = Pose3(vector(p), {q[0], q[1], q[2], q[3]});
    link.com = vector(m_.body_ipos + 3 * body);
    mjtNum r[9];
    mju_quat2Mat(r, turn);
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        for (std::size_t k = 0; k < 3; ++k) link.inertia(i, j) += r[3 * i + k] * own[k] * r[3 * j + k];
    link_of_body_[static_cast<std::size_t>(body)] = out_.links.size();
    objects_.body.push_back(body);
    objects_.is_static.push_back(info.is_static);
    const int joint = m_.body_jntadr[body];
    objects_.free.push_back(joint >= 0 && m_.jnt_type[joint] == mjJNT_FREE ? joint : -1);
    out_.links.push_back(std::move(link));
    out_.infos.push_back(std::move(info));
  }

  void links_of_bodies() {
    const auto is_link = [&](int b) { return b > 0 || m_.body_geomnum[0] > 0; };
    const std::vector<std::string> names = names_of(mjOBJ_BODY, m_.nbody, "body", is_link);
    for (int b = 0; b < m_.nbody; ++b) {
      if (!is_link(b)) continue;
      scene::LinkInfo info;
      info.name = names[static_cast<std::size_t>(b)];
      info.model = std::string(outermost(info.name));
      info.is_static = m_.body_weldid[b] == 0 && m_.body_mass[b] <= 0;
      info.visuals = visuals_of(m_, b);
      add_link(b, std::move(info));
    }
  }

  void links_as_told() {
    for (const Beside::Link& link : beside_.links) {
      const int body = mj_name2id(&m_, mjOBJ_BODY, link.info.name.c_str());
      if (body < 0) {
        problem("link", link.info.name, "no such body in the MJCF", "its bodies");
        continue;
      }
      scene::LinkInfo info = link.info;
      if (info.is_static && m_.body_weldid[body] != 0)
        problem("link", info.name, "is static and its body can move", "static=\"false\"");
      for (std::size_t v = 0; v < info.visuals.size(); ++v) {
        if (link.geoms[v].empty()) continue;
        const int geom = mj_name2id(&m_, mjOBJ_GEOM, link.geoms[v].c_str());
        if (geom < 0 || !show(m_, geom, info.visuals[v])) problem("visual@geom", link.geoms[v], "no such geom to show", "a geom");
      }
      add_link(body, std::move(info), link.weightless);
    }
    for (int b = 1; b < m_.nbody; ++b) {
      if (link_of_body_[static_cast<std::size_t>(b)] || m_.body_jntnum[b] == 0) continue;
      problem("link", name_of(m_, mjOBJ_BODY, b), "a body with a joint isn't among the links", "a <link> for it");
    }
  }

  /// That of the body, or of the next one towards the world.
  [[nodiscard]] std::optional<std::size_t> link_at(int body) const {
    while (body > 0 && !link_of_body_[static_cast<std::size_t>(body)]) body = m_.body_parentid[body];
    return link_of_body_[static_cast<std::size_t>(body)];
  }

  void geoms() {
    for (int g = 0; g < m_.ngeom; ++g) {
      std::optional<std::size_t> link = link_at(m_.geom_bodyid[g]);
      const std::string name = name_of(m_, mjOBJ_GEOM, g);
      if (!link) {  // a static link's plane or heightmap is the world's own
        const auto owns = [&](const Link& l) { return name.rfind(l.name + '/', 0) == 0; };
        const auto it = std::find_if(out_.links.begin(), out_.links.end(), owns);
        if (it == out_.links.end()) {
          scene::LinkInfo world{scoped("world"), "", 0, true, visuals_of(m_, 0)};
          world.model = std::string(outermost(world.name));
          add_link(0, std::move(world));
          link = link_of_body_[0];
        } else {
          link = static_cast<std::size_t>(it - out_.links.begin());
        }
      }
      objects_.geoms.push_back(*link);
      if (m_.geom_contype[g] == 0 && m_.geom_conaffinity[g] == 0) continue;
      Collision shape;
      shape.name = name;
      out_.links[*link].collisions.push_back(std::move(shape));
    }
  }

  void frictions() {
    for (const Beside::Friction& f : beside_.frictions) {
      const int geom = mj_name2id(&m_, mjOBJ_GEOM, f.geom.c_str()),
                body = f.of.empty() ? 0 : mj_name2id(&m_, mjOBJ_BODY, f.of.c_str());
      if (geom < 0) problem("friction@geom", f.geom, "no such geom in the MJCF", "its geoms");
      if (geom >= 0 && m_.geom_condim[geom] == 1)
        problem("friction@geom", f.geom, "has condim 1 in the MJCF, no friction", "geoms of condim 3 or more");
      if (body < 0) problem("friction@of", f.of, "no such body in the MJCF", "its bodies, or none for the world");
      objects_.directions.push_back({geom, body, f.along, f.mu, f.mu2});
      // The direction itself is only MuJoCo's objects'.
      for (Link& link : out_.links) {
        for (Collision& shape : link.collisions) {
          if (shape.name != f.geom) continue;
          shape.surface.mu = f.mu;
          shape.surface.mu2 = f.mu2;
        }
      }
    }
  }

  [[nodiscard]] static std::optional<Kind> kind_of(int type) {
    switch (type) {
      case mjJNT_HINGE:
        return Kind::hinge;
      case mjJNT_SLIDE:
        return Kind::slide;
      case mjJNT_BALL:
        return Kind::ball;
      default:
        return std::nullopt;
    }
  }

  /// Seen from the joint's other link it turns the other way.
  [[nodiscard]] Axis axis_of(int id, bool reversed) const {
    const int v = m_.jnt_dofadr[id], q = m_.jnt_qposadr[id];
    Axis axis;
    axis.xyz = reversed ? -vector(data_->xaxis + 3 * id) : vector(data_->xaxis + 3 * id);
    if (m_.jnt_limited[id] != 0 && !switched_off(m_, {"Constraint", "Limit"}))
      axis.range = {{m_.jnt_range[2 * id], m_.jnt_range[2 * id + 1]}};
    if (!without_dampers(m_)) axis.damping = m_.dof_damping[v];
    if (!switched_off(m_, {"Constraint", "Frictionloss"})) axis.friction = m_.dof_frictionloss[v];
    if (!without_springs(m_)) axis.stiffness = m_.jnt_stiffness[id];
    axis.rest = axis.stiffness > 0 ? m_.qpos_spring[q] : 0;
    return axis;
  }

  void add_joint(Joint joint, std::array<int, 2> ids) {
    if (ids[0] >= 0) joint.pose = Pose3(vector(data_->xanchor + 3 * ids[0]), {});
    const bool reversed = ids[0] >= 0 && joint.child && objects_.body[*joint.child] != m_.jnt_bodyid[ids[0]];
    if (joint.kind == Kind::universal) {
      for (const int id : ids) joint.axes.push_back(axis_of(id, reversed));
    } else if (joint.one_axis()) {
      joint.axes.push_back(axis_of(ids[0], reversed));
    }
    objects_.joints.push_back(ids);
    out_.joints.push_back(std::move(joint));
  }

  void joints_of_bodies() {
    const std::vector<std::string> names =
        names_of(mjOBJ_JOINT, m_.njnt, "joint", [&](int id) { return kind_of(m_.jnt_type[id]).has_value(); });
    for (int id = 0; id < m_.njnt; ++id) {
      const std::optional<Kind> kind = kind_of(m_.jnt_type[id]);
      if (!kind) continue;
      const int body = m_.jnt_bodyid[id];
      Joint joint;
      joint.kind = *kind;
      joint.name = names[static_cast<std::size_t>(id)];
      joint.parent = m_.body_parentid[body] == 0 ? std::nullopt : link_at(m_.body_parentid[body]);
      joint.child = link_at(body);
      add_joint(std::move(joint), {id, -1});
      const double start = m_.qpos0[m_.jnt_qposadr[id]];
      if (out_.joints.back().one_axis() && start != 0) out_.joints.back().axes[0].start = start;
    }
  }

  [[nodiscard]] std::optional<std::size_t> find_link(const std::string& joint, const std::string& name) {
    if (name.empty()) return std::nullopt;
    const auto it = std::find_if(out_.links.begin(), out_.links.end(), [&](const Link& l) { return l.name == name; });
    if (it != out_.links.end()) return static_cast<std::size_t>(it - out_.links.begin());
    problem("joint[" + joint + "]", name, "no such link", "a link's name, or nothing for the world");
    return std::nullopt;
  }

  void joints_as_told() {
    for (const Beside::Joint& told : beside_.joints) {
      Joint joint;
      joint.name = told.name;
      joint.kind = told.kind;
      joint.parent = find_link(told.name, told.parent);
      joint.child = find_link(told.name, told.child);
      std::array<int, 2> ids{-1, -1};
      if (told.closes) {
        joint.closes = true;
        joint.pose.Pos() = told.place;
        if (told.kind == Kind::hinge) joint.axes.emplace_back().xyz = told.axis;
        check_closing(joint);
        objects_.joints.push_back(ids);
        out_.joints.push_back(std::move(joint));
        continue;
      }
      if (told.kind != Kind::fixed) ids[0] = mj_name2id(&m_, mjOBJ_JOINT, told.name.c_str());
      if (told.kind == Kind::universal) ids[1] = mj_name2id(&m_, mjOBJ_JOINT, (told.name + "/2").c_str());
      const Kind single = told.kind == Kind::universal ? Kind::hinge : told.kind;
      const bool fits = ids[0] >= 0 && kind_of(m_.jnt_type[ids[0]]) == single && (told.kind != Kind::universal || ids[1] >= 0);
      if (told.kind != Kind::fixed && !fits) {
        problem("joint", told.name, "no such joint of that kind in the MJCF", "its joints");
        continue;
      }
      add_joint(std::move(joint), ids);
      if (told.start && out_.joints.back().one_axis()) out_.joints.back().axes[0].start = told.start;
    }
  }

  /// That it is a constraint of the MJCF's, and nothing else.
  void check_closing(const Joint& joint) {
    if (mj_name2id(&m_, mjOBJ_JOINT, joint.name.c_str()) >= 0)
      return problem("joint@closes", joint.name, "is a joint of the MJCF, which has a coordinate", "closes=\"false\"");
    const auto body = [&](std::optional<std::size_t> link) { return link ? objects_.body[*link] : 0; };
    const Kind kind = joint.kind;
    if (closures_of(m_, *data_, joint, body(joint.parent), body(joint.child)) < (kind == Kind::hinge ? 2 : 1))
      problem("joint@closes", joint.name, "no such equality between its links in the MJCF",
              kind == Kind::fixed  ? "a <weld>"
              : kind == Kind::ball ? "a <connect> at its place"
                                   : "two <connect> on its axis");
  }

  void couplings() {
    const auto joint = [&](int id) -> std::optional<std::size_t> {
      for (std::size_t j = 0; j < objects_.joints.size(); ++j)
        if (objects_.joints[j][0] == id) return j;
      return std::nullopt;
    };
    for (int e = 0; e < m_.neq && !without_equalities(m_); ++e) {
      if (m_.eq_type[e] != mjEQ_JOINT || m_.eq_obj2id[e] < 0 || !starts_active(m_, e)) continue;
      const auto follower = joint(m_.eq_obj1id[e]), leader = joint(m_.eq_obj2id[e]);
      if (!follower || !leader) continue;
      const auto start = [&](int id) { return m_.qpos0[m_.jnt_qposadr[id]]; };
      const std::array<double, 5> c =
          from_zero(m_.eq_data + static_cast<std::ptrdiff_t>(mjNEQDATA) * e, start(m_.eq_obj1id[e]), start(m_.eq_obj2id[e]));
      out_.couplings.push_back({*follower, *leader, c[1], c[0], {c[2], c[3], c[4]}});
    }
  }

  /// MuJoCo counts both joints from where they start: q_f − f0 = Σ p_k (q − l0)^k. The same polynomial in q.
  static std::array<double, 5> from_zero(const mjtNum* p, double f0, double l0) {
    std::array<double, 5> c{};
    for (std::size_t k = 5; k-- > 0;) {  // c ← c·(q − l0) + p_k
      for (std::size_t i = 4; i > 0; --i) c[i] = c[i - 1] - l0 * c[i];
      c[0] = p[k] - l0 * c[0];
    }
    c[0] += f0;
    return c;
  }

  const mjModel& m_;
  const std::string& file_;
  const Beside& beside_;
  description::World& out_;
  LinkObjects& objects_;
  Problems& problems_;
  DataPtr data_;
  std::vector<std::optional<std::size_t>> link_of_body_;
};

}  // namespace

void describe(const mjModel& model, const std::string& file, const Beside& beside, description::World& out, LinkObjects& objects,
              Problems& problems) {
  Describer(model, file, beside, out, objects, problems).all();
}

}  // namespace vsa::physics
