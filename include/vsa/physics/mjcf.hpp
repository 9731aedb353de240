// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Worlds in MuJoCo's own format, MJCF: where no SDF can be read, and for robots that come so.
//
// MuJoCo steps the file as it stands. A body is a link, a joint with one degree of freedom a joint, the `model` of <mujoco> the
// model; names with "::" bring their models along. Actuators are a <plugin name="vsa::Robot"> element as in SDF, in a
// <custom><text name="vsa::Robot" data="…"/></custom>, or in the file beside it, for NAME.xml NAME.vsa.xml:
//
//   <vsa>
//     <world name="…"/>
//     <link name="lab::arm::upper" model="lab" static="true" mass_kg="1">       the body of that name; links in this order;
//                                                                             gravity="false": gravity leaves it alone
//       <visual shape="box" pose="x y z qw qx qy qz" size="x y z" rgba="r g b a"/>   as vsa/scene/link.hpp has them
//       <visual shape="mesh" …><vertices>x y z …</vertices><triangles>0 1 2 …</triangles></visual>
//       <visual shape="heightmap" geom="…" rgba="…"/>                               the MJCF's geom of that name
//     </link>
//     <friction geom="…" mu="0.5" mu2="1" along="0 1 0" of="lab::arm::upper"/>   of a geom whose friction is the larger of the two: mu
//                                                                             along that unit vector of a body's (else the world's)
//     <joint name="lab::arm::elbow" kind="hinge" parent="lab::arm::upper" child="…" start="0.1"/>    fixed ones, too;
//                            closes="true" place="x y z" axis="x y z": closes a loop, and is the MJCF's connects or weld
//     <robot model="lab::arm" top_model="lab"><plugin name="vsa::Robot">…</plugin></robot>
//   </vsa>
//
// Each part may be left out: then links, joints and visuals are the bodies, joints and geoms of the MJCF.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "vsa/description/world.hpp"
#include "vsa/errors.hpp"

namespace vsa::physics {

/// A world as read from an MJCF.
struct MjcfRead {
  description::World world;   ///< its `native` is MuJoCo's
  bool names_others = false;  ///< the file names others: meshes, includes
};

/// From a file, or where `path` is empty from `text`. Everything wrong goes to `problems`, in MuJoCo's words where it refuses the
/// file; the world is complete only where nothing was. Safe from several threads.
[[nodiscard]] MjcfRead read_mjcf(const std::filesystem::path& path, std::string_view text, std::vector<std::string>& warnings,
                                 Problems& problems);

/// NAME.xml and NAME.vsa.xml, which needn't be there.
[[nodiscard]] std::vector<std::filesystem::path> files_of_mjcf(const std::filesystem::path& path);

/// Whether that is MJCF: by the root element of a text, by .xml or .mjcf of a file.
[[nodiscard]] bool is_mjcf(const std::filesystem::path& path, std::string_view text);

/// Whether somewhere in that text an attribute of this name is given, whatever it belongs to; `value`: given so.
[[nodiscard]] bool gives_attribute(std::string_view xml, std::string_view name, std::string_view value = {});

/// `text` as it stands in an attribute there.
[[nodiscard]] std::string escaped(const std::string& text);

/// A file that write_mjcf_files() makes.
struct WrittenFile {
  std::string name,  ///< without a directory
      bytes;         ///< what is in it
};

/// NAME.xml, NAME.vsa.xml and what they name, for a world that came from elsewhere. read_mjcf() of it moves bit for bit as `world`
/// does. `file`: where the world is from, for problems.
[[nodiscard]] std::vector<WrittenFile> write_mjcf_files(const description::World& world, const std::string& name,
                                                        std::string_view file, Problems& problems);

}  // namespace vsa::physics
