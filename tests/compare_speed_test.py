"""Tests of the judgement of compare_speed.py: python3 tests/compare_speed_test.py"""

import unittest

import compare_speed


class Judgement(unittest.TestCase):
    def failing(self, name, ratios):
        rounds = [({"tick": 100.0, name: 200.0}, {"tick": 100.0, name: 200.0 * ratio})
                  for ratio in ratios]
        return [row[0] for row in compare_speed.too_slow(compare_speed.slower(rounds))]

    def test_names_a_time_that_grew_in_every_round(self):
        self.assertEqual(self.failing("jump", [1.2, 1.15, 1.3, 1.01, 1.2, 1.2]), ["jump"])

    def test_passes_where_one_round_disagrees(self):
        self.assertEqual(self.failing("jump", [1.2, 1.2, 1.2, 0.99, 1.2, 1.2]), [])

    def test_passes_below_the_limit(self):
        self.assertEqual(self.failing("jump", [1.09] * 6), [])

    def test_skips_a_time_that_one_program_lacks(self):
        rounds = [({"tick": 100.0}, {"tick": 100.0, "new": 900.0})] * 6
        self.assertEqual([row[0] for row in compare_speed.slower(rounds)], ["tick"])


if __name__ == "__main__":
    unittest.main()
