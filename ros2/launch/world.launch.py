# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""A world in gz-sim, and the bridge that gives its robot ROS 2 topics.

  ros2 launch vsa_ros2 world.launch.py world:=snake_rubble robot:=qbmove_snake

Needs what vsasim installed: `. PREFIX/share/vsa/setup.sh`, or the same hook of a colcon workspace, before.
"""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription
from launch.conditions import IfCondition
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import EnvironmentVariable, LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    # One text of several parts: PathJoinSubstitution takes no lists in Humble and Jazzy.
    world = [EnvironmentVariable('VSA_DATA_DIR'), '/models/worlds/', LaunchConfiguration('world'), '.sdf']
    simulator = IncludeLaunchDescription(
        PythonLaunchDescriptionSource(
            PathJoinSubstitution([FindPackageShare('ros_gz_sim'), 'launch', 'gz_sim.launch.py'])),
        launch_arguments={'gz_args': [LaunchConfiguration('gz_options'), ' '] + world}.items(),
        condition=IfCondition(LaunchConfiguration('simulator')),
    )
    bridge = Node(
        package='ros_gz_bridge',
        executable='parameter_bridge',
        name='vsa_bridge',
        output='screen',
        parameters=[{
            'config_file': PathJoinSubstitution([
                FindPackageShare('vsa_ros2'), 'config', LaunchConfiguration('robot'), 'bridge.yaml',
            ]),
        }],
    )
    return LaunchDescription([
        DeclareLaunchArgument('world', default_value='bench_load',
                              description='A world of vsasim, without .sdf'),
        DeclareLaunchArgument('robot', default_value='qbmove_bench_load',
                              description='The model in it whose topics are bridged'),
        DeclareLaunchArgument('gz_options', default_value='-r',
                              description='Options of gz sim: -r runs at once, -s leaves the window out'),
        DeclareLaunchArgument('simulator', default_value='true',
                              description='false: only the bridge, to a simulator that runs already'),
        simulator,
        bridge,
    ])
