# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""Every line of every bridge: are its types a pair that the bridge converts, and is its Gazebo topic one of the robot's?

bridge_test.py SOURCE_DIR ROBOT_TOPICS: the second is the program that asks the library for the topics' names.
"""

import json
import pathlib
import re
import subprocess
import sys
import unittest

import yaml

SOURCE, PROGRAM = pathlib.Path(sys.argv[1]).resolve(), sys.argv[2]
CONFIG = SOURCE / 'ros2' / 'config'
WORLDS = sorted((SOURCE / 'models' / 'worlds').glob('*.sdf'))
# What the bridge's parser reads of an entry (ros_gz_bridge/src/bridge_config.cpp).
KEYS = {'ros_topic_name', 'gz_topic_name', 'ros_type_name', 'gz_type_name', 'direction', 'lazy'}
WAYS = {'GZ_TO_ROS': 'to_ros', 'ROS_TO_GZ': 'to_gz'}
# A ROS 2 name: tokens of letters, digits and single underscores, none starting with a digit (design.ros2.org, topic names).
ROS_NAME = re.compile(r'(/[A-Za-z][A-Za-z0-9]*(_[A-Za-z0-9]+)*)+')


def topics_of_robots():
    """Model -> set of (topic, type, way), as the library says."""
    said = subprocess.run([PROGRAM, *map(str, WORLDS)], check=True, capture_output=True, text=True).stdout
    robots = {}
    for line in said.splitlines():
        _, model, way, kind, topic = line.split()
        robots.setdefault(model, set()).add((topic, kind, way))
    return robots


def bridges():
    return {file.parent.name: yaml.safe_load(file.read_text()) for file in sorted(CONFIG.glob('*/bridge.yaml'))}


class Bridges(unittest.TestCase):
    def test_every_robot_has_a_bridge_and_every_bridge_a_robot(self):
        robots = topics_of_robots()
        self.assertIn('qbmove_snake', robots)
        self.assertEqual(set(bridges()), set(robots))

    def test_entries_have_the_keys_that_the_bridge_reads(self):
        for model, entries in bridges().items():
            self.assertIsInstance(entries, list)
            for entry in entries:
                self.assertLessEqual(set(entry), KEYS, model)
                self.assertGreaterEqual(set(entry), KEYS - {'lazy'}, model)
                self.assertIn(entry['direction'], WAYS)

    def test_types_are_pairs_of_the_bridges_own_list(self):
        tables = json.loads((pathlib.Path(__file__).parent / 'bridge_types.json').read_text())
        for version in ('humble', 'jazzy'):
            pairs = tables[version]['pairs']
            for model, entries in bridges().items():
                for entry in entries:
                    self.assertIn(entry['gz_type_name'], pairs.get(entry['ros_type_name'], []), f'{version}: {model}: {entry}')

    def test_gazebo_topics_are_exactly_those_of_the_robot(self):
        robots = topics_of_robots()
        for model, entries in bridges().items():
            bridged = [(e['gz_topic_name'], e['gz_type_name'], WAYS[e['direction']]) for e in entries]
            self.assertEqual(len(bridged), len(set(bridged)), model)
            clock = ('/clock', 'gz.msgs.Clock', 'to_ros')
            self.assertEqual(set(bridged) - {clock}, robots[model], model)
            self.assertIn(clock, bridged)

    def test_ros_topics_are_valid_names_used_once(self):
        for model, entries in bridges().items():
            names = [entry['ros_topic_name'] for entry in entries]
            self.assertEqual(len(names), len(set(names)), model)
            for name in names:
                self.assertRegex(name, ROS_NAME)
                self.assertIsNotNone(ROS_NAME.fullmatch(name), name)

    def test_the_table_of_the_documentation_names_what_is_bridged(self):
        text = (SOURCE / 'docs' / 'howto' / 'ros2.md').read_text()
        rows = re.findall(r'^\| `/M/(\S+)` \| (\S+) \| (to|from) ROS \|', text, re.M)
        said = {(name, kind, 'ROS_TO_GZ' if way == 'from' else 'GZ_TO_ROS') for name, kind, way in rows}
        entries = bridges()['qbmove_bench_load']
        have = {(e['ros_topic_name'].replace('/qbmove_bench_load/', '').replace('shaft/', 'J/'), e['ros_type_name'].split('/')[-1],
                 e['direction']) for e in entries if e['ros_topic_name'] != '/clock'}
        self.assertEqual(said, have)


if __name__ == '__main__':
    unittest.main(argv=sys.argv[:1], verbosity=2)
