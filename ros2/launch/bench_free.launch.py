# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""The bench with a free flange, with ROS 2 topics."""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument('world', default_value='bench_free', description='A world of vsasim, without .sdf'),
        DeclareLaunchArgument('gz_options', default_value='-r', description='Options of gz sim'),
        DeclareLaunchArgument('simulator', default_value='true', description='false: only the bridge'),
        IncludeLaunchDescription(
            PythonLaunchDescriptionSource(
                PathJoinSubstitution([FindPackageShare('vsa_ros2'), 'launch', 'world.launch.py'])),
            launch_arguments={
                'world': LaunchConfiguration('world'),
                'robot': 'qbmove_bench_free',
                'gz_options': LaunchConfiguration('gz_options'),
                'simulator': LaunchConfiguration('simulator'),
            }.items(),
        ),
    ])
