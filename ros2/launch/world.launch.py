# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""A world in gz-sim, and the bridge that gives its robot ROS 2 topics.

  ros2 launch vsa_ros2 world.launch.py world:=snake_rubble

Needs what vsasim installed: `. PREFIX/share/vsa/setup.sh`, or the same hook of a colcon workspace, before.
"""

import pathlib
import re
import shlex

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription, OpaqueFunction
from launch.conditions import IfCondition
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import EnvironmentVariable, LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.substitutions import FindPackageShare


def world_file(name, data):
    if not data:
        raise RuntimeError('VSA_DATA_DIR is unset: . PREFIX/share/vsa/setup.sh before')
    worlds = pathlib.Path(data, 'models', 'worlds')
    file = worlds / f'{name}.sdf'
    if not file.is_file():
        there = ', '.join(sorted(f.stem for f in worlds.glob('*.sdf'))) or 'none'
        raise RuntimeError(f'world:={name}: there is no {file} (allowed: {there})')
    return file


def robot_in(file, bridged):
    """The one model that the world includes and that has a bridge."""
    robots = [m for m in re.findall(r'<uri>\s*model://([^\s/<]+)', file.read_text(encoding='utf-8')) if m in bridged]
    if len(set(robots)) != 1:
        found = ', '.join(sorted(set(robots))) or 'none'
        raise RuntimeError(f'{file}: of the robots with a bridge it includes {found}: name one by robot:=')
    return robots[0]


def start(context):
    world, robot, options, simulated = (LaunchConfiguration(name).perform(context)
                                        for name in ('world', 'robot', 'gz_options', 'simulator'))
    data = EnvironmentVariable('VSA_DATA_DIR', default_value='').perform(context)
    configurations = pathlib.Path(FindPackageShare('vsa_ros2').perform(context), 'config')
    bridged = sorted(file.parent.name for file in configurations.glob('*/bridge.yaml'))
    # The bridge alone needs no world's file where the robot is named.
    file = world_file(world, data) if simulated.lower() in ('true', '1') or not robot else None
    robot = robot or robot_in(file, bridged)
    if robot not in bridged:
        raise RuntimeError(f'robot:={robot}: there is no {configurations / robot / "bridge.yaml"} (allowed: {", ".join(bridged)})')
    if file and not re.search(rf'\b{re.escape(robot)}\b', file.read_text(encoding='utf-8')):
        raise RuntimeError(f'robot:={robot}: {file} has no such model')
    # ros_gz_sim gives its text to a shell.
    simulator = IncludeLaunchDescription(
        PythonLaunchDescriptionSource(
            PathJoinSubstitution([FindPackageShare('ros_gz_sim'), 'launch', 'gz_sim.launch.py'])),
        launch_arguments={'gz_args': f'{options} {shlex.quote(str(file))}'}.items(),
        condition=IfCondition(LaunchConfiguration('simulator')),
    )
    bridge = Node(
        package='ros_gz_bridge',
        executable='parameter_bridge',
        name='vsa_bridge',
        output='screen',
        parameters=[{'config_file': str(configurations / robot / 'bridge.yaml')}],
    )
    return [simulator, bridge]


def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument('world', default_value='bench_load',
                              description='A world of vsasim, without .sdf'),
        DeclareLaunchArgument('robot', default_value='',
                              description='The model in it whose topics are bridged; unless given, the one that has a bridge'),
        DeclareLaunchArgument('gz_options', default_value='-r',
                              description='Options of gz sim: -r runs at once, -s leaves the window out'),
        DeclareLaunchArgument('simulator', default_value='true',
                              description='false: only the bridge, to a simulator that runs already'),
        OpaqueFunction(function=start),
    ])
