"""Members of states and forces: the lists in src/work/ask, railstrata.h, what tools/write_interface.py writes."""
import re
import subprocess
import sys
import unittest
from pathlib import Path

SOURCE = Path(sys.argv[1])
sys.path.insert(0, str(SOURCE / "tools"))
import write_interface  # noqa: E402

HEADER = (SOURCE / write_interface.HEADER).read_text()
LISTS = {"kForces": ("contact", "rs_forces"), "kPatchForces": ("patch_forces", "rs_patch"),
         "kWheelForces": ("wheelset", "rs_wheel"), "kWheelsetState": ("wheelset", "rs_wheelset_state"),
         "kWheelsetForces": ("wheelset", "rs_wheelset_forces")}


def rows(name, file):
    """Name, unit and what follows of each row of a list in C++."""
    text = (SOURCE / f"src/work/ask/{file}.hpp").read_text()
    found = re.search(rf"\b{name}\b[^;]*?[{{=].*?}};\n|\b{name} = .*?\n}}\(\);\n", text, re.S)
    return re.findall(r'\{"(\w+)",\s*"([^"]*)",\s*([^,}]+)', found[0])


def members(struct, header=HEADER):
    """Name and comment of each number of a struct."""
    return [(name, comment) for _, names, comment in write_interface.structs(header)[struct] for name, _ in names
            if name not in ("size", "given", "wheel") and not name.startswith("reserved")]


class Interface(unittest.TestCase):
    def compare(self, listed, struct):
        in_c = members(struct)
        self.assertEqual([name for name, *_ in listed], [name for name, _ in in_c], struct)
        for (name, unit, *_), (_, comment) in zip(listed, in_c):
            if unit:
                self.assertRegex(comment, rf"(?<![\w/]){re.escape(unit)}(?![\w/])", f"{struct}.{name}")

    def test_lists_have_the_members_of_the_header_in_its_order(self):
        for name, (file, struct) in LISTS.items():
            with self.subTest(name):
                self.compare(rows(name, file), struct)
        slopes = [name for name, _ in members("rs_derivatives")]
        self.assertEqual(slopes, [name for name, *_ in rows("kForces", "contact")][:len(slopes)])

    def test_bits_of_a_state_follow_the_order_of_its_members(self):
        state = sorted(rows("kState", "state"), key=lambda row: int(row[2]))
        self.compare(state, "rs_state")
        self.assertEqual([int(bit) for *_, bit in state], [2 ** k for k in range(len(state))])
        self.assertEqual(write_interface.bits(HEADER, write_interface.BITS[0]),
                         [(f"RS_{name.upper()}", bit) for name, _, bit in state])

    def test_inputs_of_a_wheelsets_derivatives_are_the_places_of_its_members(self):
        state = [f"RS_BY_{name.upper()}" for name, *_ in rows("kWheelsetState", "wheelset")]
        self.assertEqual(len(state), 19)
        self.assertEqual(write_interface.inputs(HEADER),
                         [(name, str(k)) for k, name in enumerate(state)] + [("RS_OF_RIGHT", "32")])
        added = HEADER.replace("#define RS_BY_RAIL_YAW 18\n", "#define RS_BY_RAIL_YAW 18\n#define RS_BY_WIND 19\n")
        module = (SOURCE / "src/doors/capi/railstrata.f90").read_text()
        for header, last in ((HEADER, "rs_by_rail_yaw=18"), (added, "rs_by_wind=19")):
            written = re.sub(r"[\s&]", "", write_interface.fortran(module, header))
            self.assertIn(f"{last},rs_of_right=32", written)

    def test_fortran_and_python_follow_the_header(self):
        subprocess.run([sys.executable, SOURCE / "tools/write_interface.py", "--check"], check=True)

    def test_a_new_member_of_the_state_is_written_everywhere(self):
        """By hand: its member and row in ask/state.hpp, and its bit and member in railstrata.h."""
        header = HEADER.replace("#define RS_FORCE_Y 2048u\n", "#define RS_FORCE_Y 2048u\n#define RS_WETNESS 4096u\n")
        header = header.replace("} rs_state;", "  double wetness; /* kg/m2, of water */\n} rs_state;")
        after = {name: write((SOURCE / name).read_text(), header) for name, write in write_interface.WRITTEN.items()}
        fortran, python = after["src/doors/capi/railstrata.f90"], after["python/railstrata/contact.py"]
        self.assertIn("rs_wetness = 4096", fortran)
        self.assertIn("wetness = 0", fortran)
        self.assertIn("wetness: Optional[float] = None", python)
        self.assertIn("wetness: kg/m², of water.", " ".join(python.split()))
        naming = [file.name for file in (SOURCE / "src").rglob("*.?pp") if "RS_SPIN" in file.read_text()]
        self.assertEqual(naming, [], "a member has its bit from its row")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
