"""The program as a user meets it: words in, exit code and texts out."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

BINARY = pathlib.Path(sys.argv[1]).resolve()
sys.dont_write_bytecode = True

# A disc with a crowned tread on a block, 30 mm of rolling: the whole chain in a second.
TINY = """
[geometry]
rail_profile = "flat"
wheel_profile = "arc:R=430 mm"
rail_shape = "block"
wheel_shape = "disc"
cant = 0.0
bore_radius = "250 mm"
[vehicle]
wheel_mass = "1500 kg"
sprung_mass = "7000 kg"
[mesh]
element_size = "4 mm"
fine_width = "32 mm"
coarse_ratio = 2
largest = "20 mm"
end_length = "60 mm"
[run]
positions = ["30 mm"]
window = "8 mm"
run_up = "0 mm"
"""


def railstrata(*words, cwd=None):
    done = subprocess.run([BINARY, *map(str, words)], capture_output=True, text=True, timeout=120, cwd=cwd)
    return done.returncode, done.stdout, done.stderr


class FromOutside(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))

    def case(self, text):
        file = self.folder / "case.toml"
        file.write_text(text)
        return file

    def refused(self, code, words, *messages):
        rc, out, err = railstrata(*words)
        self.assertEqual(rc, code, err)
        for message in messages:
            self.assertIn(message, err)
        return out
