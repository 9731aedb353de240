// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Robots for robots(): shapes, and what stands in a <gazebo>.
#include <initializer_list>

#include "urdf/robot_text.hpp"

namespace vsa::reader::testing {

void add_shapes(Robots& out) {
  out["mesh_scaled"] = with_link(mesh(parts("box.stl"), "2 0.5 -1.25") + mesh(parts("box.stl"), "0.001 0.001 0.001", "visual"));
  out["mesh_collada"] = with_link(mesh(parts("box.dae"), "1 1 1"));
  out["mesh_concave"] = with_link(mesh(parts("concave.stl"), "1 1 1"));
  out["mesh_missing"] = with_link(mesh("no/such.stl", "1 1 1"));
  out["mesh_of_no_package"] = with_link(mesh("package://no_such/box.stl", "1 1 1"));
  out["mesh_no_format"] = with_link(mesh(Text(VSA_SOURCE_DIR) + "/README.md", "1 1 1"));
  out["mesh_scale_of_two"] = with_link(mesh(parts("box.stl"), "1 1"));
  out["visual_missing"] = with_link(mesh("no/such.stl", "1 1 1", "visual"));
  out["materials"] = robot(
      "<material name=\"red\"><color rgba=\"0.5 0.1 0 0.5\"/></material>\n" + kBase +
      link(
          "a",
          inertial() +
              R"(<visual><geometry><sphere radius="0.1"/></geometry><material name="red"/></visual>)"
              R"(<visual><geometry><sphere radius="0.2"/></geometry><material name="own"><color rgba="1 1 1 1"/></material></visual>)"
              R"(<visual><geometry><sphere radius="0.3"/></geometry><material name="nowhere"/></visual>)"
              R"(<visual><geometry><sphere radius="0.4"/></geometry></visual>)") +
      kHinge);
  out["material_broken"] = robot("<material name=\"red\"><color rgba=\"0.5 0.1 0\"/></material>\n" + kArm);
  for (const auto& [name, shape] :
       std::initializer_list<std::pair<const char*, const char*>>{{"sphere_of_0", "<sphere radius=\"0\"/>"},
                                                                  {"box_of_two", "<box size=\"1 2\"/>"},
                                                                  {"box_negative", "<box size=\"1 2 -3\"/>"},
                                                                  {"none", ""},
                                                                  {"unknown", "<cone/>"},
                                                                  {"capsule", "<capsule radius=\"0.1\" length=\"0.2\"/>"}})
    out[Text("shape_") + name] = with_link(Text("<collision><geometry>") + shape + "</geometry></collision>");
  out["shape_without_geometry"] = with_link("<collision/>");
}

void add_gazebos(Robots& out) {
  for (const auto& [name, content] : std::initializer_list<std::pair<const char*, const char*>>{
           {"mu", "<mu1>0.3</mu1><mu2 value='0.3'/>"},
           {"mu_one", "<mu1>0.3</mu1>"},
           {"mu_huge", "<mu1>1e9</mu1><mu2>50</mu2>"},
           {"mu_direction", "<mu1>0.3</mu1><mu2>0.6</mu2><fdir1>0 1 0</fdir1>"},
           {"mu_negative", "<mu1>-1</mu1>"},
           {"mu_twice", "<mu1>0.2</mu1><mu1>0.4</mu1><mu2>0.4</mu2>"},
           {"springs", "<kp>1e5</kp><kd>10</kd>"},
           {"max_vel", "<maxVel>0.1</maxVel>"},
           {"self_collide", "<selfCollide>true</selfCollide>"},
           {"self_collide_word", "<selfCollide>maybe</selfCollide>"},
           {"wind", "<enable_wind>false</enable_wind>"},
           {"gravity_off", "<turnGravityOff>true</turnGravityOff>"},
           {"sdf_self_collide", "<self_collide>1</self_collide>"},
           {"sdf_gravity", "<gravity>0</gravity>"},
           {"kinematic", "<kinematic>true</kinematic>"},
           {"decay", "<velocity_decay><linear>0.1</linear></velocity_decay>"},
           {"decay_0", "<velocity_decay><linear>0</linear></velocity_decay>"},
           {"damping_factor_0", "<dampingFactor>0</dampingFactor>"},
           {"surface",
            "<collision><surface><friction><ode><mu>0.4</mu><mu2>0.4</mu2></ode></friction><contact><collide_bitmask>1</"
            "collide_bitmask></contact></surface></collision>"},
           {"surface_and_mu",
            "<mu1>0.2</mu1><collision><surface><friction><ode><mu>0.4</mu><mu2>0.2</mu2></ode></friction></surface></collision>"},
           {"torsional",
            "<collision><surface><friction><torsional><coefficient>0.5</coefficient><patch_radius>0.02</patch_radius></torsional></"
            "friction></surface></collision>"},
           {"bounce",
            "<collision><surface><bounce><restitution_coefficient>0.5</restitution_coefficient></bounce></surface></collision>"},
           {"unused", "<maxContacts>1</maxContacts><laserRetro>2</laserRetro>"},
           {"collision_unused", "<collision><max_contacts>1</max_contacts><laser_retro>2</laser_retro></collision>"},
           {"surface_unused",
            "<collision><surface><bounce><threshold>0.1</threshold></bounce><contact><poissons_ratio>0.1</"
            "poissons_ratio></contact></surface></collision>"},
           {"surface_typo", "<collision><surface><frictoin/></surface></collision>"},
           {"collision_typo", "<collision><frictoin/></collision>"},
           {"light", "<light name='l' type='point'/>"},
           {"unknown", "<selfcollide>true</selfcollide>"},
           {"namespaced", "<my:thing>1</my:thing>"},
           {"link_plugin", "<plugin name='p' filename='p.so'/>"},
           {"link_static", "<static>true</static>"},
           {"of_joints", "<springStiffness>1</springStiffness>"},
           {"visual", "<visual><material><diffuse>1 0 0 1</diffuse></material></visual>"}})
    out[Text("gazebo_") + name] = with_gazebo("a", content);
  for (const auto& [name, content] : std::initializer_list<std::pair<const char*, const char*>>{
           {"spring", "<springStiffness>2</springStiffness><springReference>0.1</springReference>"},
           {"spring_negative", "<springStiffness>-2</springStiffness>"},
           {"physics", "<physics><ode><cfm_damping>1</cfm_damping></ode></physics>"},
           {"unknown", "<damping>1</damping>"},
           {"axis", "<axis><xyz>1 0 0</xyz></axis>"},
           {"mu", "<mu1>0.3</mu1>"},
           {"feedback", "<provideFeedback>true</provideFeedback><implicitSpringDamper>1</implicitSpringDamper>"}})
    out[Text("gazebo_joint_") + name] = with_gazebo("j1", content);
  for (const auto& [name, content] : std::initializer_list<std::pair<const char*, const char*>>{
           {"static", "<static>true</static>"},
           {"static_word", "<static>ja</static>"},
           {"self_collide", "<self_collide>true</self_collide>"},
           {"mu", "<mu1>0.1</mu1>"},
           {"collision", "<collision/>"},
           {"unknown", "<plugn/>"},
           {"wind", "<enable_wind>true</enable_wind>"},
           {"pose", "<pose>1 2 3 0.1 0.2 0.3</pose>"},
           {"pose_of_five", "<pose>1 2 3 0 0</pose>"},
           {"link", "<link name='more'><inertial><mass>1</mass></inertial></link>"},
           {"foreign_plugin", "<plugin name='p' filename='libp.so'><x/></plugin>"}})
    out[Text("gazebo_robot_") + name] = with_gazebo("", content);
  out["plugin"] = with_gazebo("", kPlugin);
  out["plugin_on_static"] = with_gazebo("", "<static>1</static>" + kPlugin);
  Text misnamed = kPlugin;
  out["plugin_misnamed"] = with_gazebo("", misnamed.replace(misnamed.find("vsa::Robot"), 10, "vsa"));
}

}  // namespace vsa::reader::testing
