#!/usr/bin/env python3
"""`study` from outside: what it computes, what it skips, what a kill leaves. usage: study_test.py BINARY SOURCE_DIR
[KILLS]

KILLS: how many times a study by finite elements is killed at a random moment (default 4), one by half-spaces half as
often again."""
import contextlib
import csv
import json
import os
import pathlib
import random
import shlex
import shutil
import signal
import subprocess
import sys
import time

from outside import SMALL, TINY, FromOutside, broken_files, fact, main, railstrata, results, slow, start

SOURCE = pathlib.Path(sys.argv[2]).resolve()
KILLS = int(sys.argv[3]) if len(sys.argv) > 3 else 4
BASE, LAYERED = SOURCE / "cases/paper/base.toml", SOURCE / "cases/paper/layer_3mm_2E0.toml"
# Half-spaces on coarse cells: some hundredths of a second each.
GRID = f"""
[study]
title = "tests"
base = "{LAYERED}"
engines = ["bem"]
cell = "1.5 mm"
[[group]]
name = "grid"
[group.vary]
"layer.0.thickness" = ["1 mm", "2 mm"]
"layer.0.young_ratio" = [1.5, 2, 4]
"""


def table(file):
    return list(csv.DictReader(line for line in file.read_text().splitlines() if not line.startswith("#")))


def numbers(rows):
    """Without how a case was computed, which two studies may do differently."""
    return [{key: value for key, value in row.items() if key not in ("wall_s", "threads")} for row in rows]


class StudyTest(FromOutside):
    def setUp(self):
        super().setUp()
        self.out = self.folder / "out"

    def study(self, text):
        file, new = self.folder / "study.toml", self.folder / "study.toml.new"
        new.write_text(text)
        return new.replace(file)  # whole at every moment: a study that has started may still be reading it

    def solve(self, text, *words, code=0):
        rc, out, err = railstrata("study", self.study(text), "--out", self.out, "--no-report", *words)
        self.assertEqual(rc, code, err)
        return err

    def start(self, text, *words, **options):
        return start("study", self.study(text), "--out", self.out, "--no-report", *words, **options)

    def end_well(self, processes, code=0):
        errors = [process.communicate()[1] for process in processes]  # all of them, so that none outlives a failure
        self.assertEqual([process.returncode for process in processes], [code] * len(processes), errors)

    def pretended_job(self, task):
        """Environment of a job that runs in Slurm, with commands that write down what they are asked for; slurm_test.py
        has a real one."""
        for name, text in (("squeue", "echo running"), ("scontrol", f"echo $* >> {self.folder}/requeued")):
            (self.folder / name).write_text(f"#!/bin/sh\n{text}\n")
            (self.folder / name).chmod(0o755)
        return {**os.environ, "SLURM_ARRAY_JOB_ID": "7", "SLURM_ARRAY_TASK_ID": str(task), "SLURM_CPUS_PER_TASK": "1",
                "PATH": f"{self.folder}:{os.environ['PATH']}"}

    def rows(self):
        return table(self.out / "study.csv")

    def stamps(self):
        return {str(file.relative_to(self.out)): file.stat().st_mtime_ns for file in self.out.rglob("study.json")
                if ".part-" not in str(file)}

    def left_behind(self):
        return [str(file) for file in self.out.rglob("*") if ".part" in file.name]


class Cases(StudyTest):
    def test_its_numbers_are_those_of_bem_and_every_case_has_its_folder(self):
        self.solve(GRID)
        note, copy = (self.out / "study.toml").read_text().split("\n", 1)
        self.assertRegex(note, r"^# A copy for the record of \S+\.toml: run that one, ")
        self.assertEqual(copy, GRID)
        rows = self.rows()
        self.assertEqual([(r["layer.0.thickness"], r["layer.0.young_ratio"]) for r in rows],
                         [(h, e) for h in ("1 mm", "2 mm") for e in ("1.5", "2", "4")])
        rc, out, err = railstrata("bem", LAYERED, "--cell", "1.5 mm", "--set", "layer.0.thickness=2 mm", "--set",
                                  "layer.0.young_ratio=1.5", "--out", self.folder / "one", "--no-report", "--json")
        self.assertEqual(rc, 0, err)
        alone, row = json.loads(out), rows[3]
        self.assertEqual(float(row["p_max_MPa"]), 1e-6 * alone["contact"]["p_max_Pa"])
        self.assertEqual(float(row["rail_subsurface_von_mises_MPa"]),
                         1e-6 * alone["stress"]["rail"]["subsurface"]["von_mises_max"]["value_Pa"])
        self.assertEqual((self.out / row["folder"] / "patch.csv").read_text().split("\n", 3)[3],
                         (self.folder / "one" / "patch.csv").read_text().split("\n", 3)[3])
        section = table(self.out / row["folder"] / "rail_longitudinal_section.csv")
        self.assertAlmostEqual(float(row["section_von_mises_MPa"]), max(float(r["von_mises_MPa"]) for r in section))

    def test_the_same_case_in_two_groups_is_computed_once(self):
        err = self.solve(GRID
                         + f'[[group]]\nname = "again"\nset = {{ "layer.0.young_ratio" = 2 }}\n[group.vary]\n'
                           f'"layer.0.thickness" = ["2 mm", "3 mm"]\n')
        self.assertIn("7 cases, 7 of them to compute", err)
        rows = self.rows()
        self.assertEqual(rows[6]["folder"], rows[4]["folder"])
        self.assertEqual(rows[6]["p_max_MPa"], rows[4]["p_max_MPa"])
        self.assertEqual(len(self.stamps()), 7)
        before = self.stamps()
        grid = GRID.index("[[group]]")
        self.assertIn("0 of them to compute",
                      self.solve(GRID[:grid]
                                 + '[[group]]\nname = "again"\nset = { "layer.0.young_ratio" = 2 }\n[group.vary]\n'
                                   '"layer.0.thickness" = ["2 mm", "3 mm"]\n' + GRID[grid:]))
        self.assertEqual(self.stamps(), before, "in another order too")

    def test_both_engines(self):
        self.case(TINY)
        # a check of so coarse a rolling fails, and is reported
        self.solve('[study]\nbase = "case.toml"\ncell = "1 mm"\n[[group]]\nname = "wheel"\n', code=1)
        fem, bem = self.rows()
        self.assertEqual([fem["engine"], bem["engine"]], ["fem", "bem"])
        self.assertIn("check failed", fem["fault"])
        self.assertAlmostEqual(float(fem["F_z_kN"]) / float(bem["F_z_kN"]), 1, delta=0.1)
        self.assertIn("2 cases, 0 of them to compute", self.solve((self.folder / "study.toml").read_text(), code=1))
        only = self.solve((self.folder / "study.toml").read_text(), "--engine", "bem")
        self.assertIn("1 cases, 0 of them to compute", only)
        self.assertEqual([r["state"] for r in self.rows()], ["done", "done"], "the table is that of the whole study")

    def test_one_failing_case_leaves_the_others_alone_and_is_tried_again(self):
        text = GRID + '[[group]]\nname = "bad"\n[group.vary]\n"geometry.gauge" = ["1.7 m", "1.436 m"]\n'
        err = self.solve(text, code=1)
        self.assertIn("1 of 8 cases failed", err)
        rows = self.rows()
        self.assertEqual([r["state"] for r in rows], ["done"] * 6 + ["failed", "done"])
        self.assertIn("the wheel misses the rail", rows[6]["fault"])
        self.assertEqual(rows[6]["p_max_MPa"], "")
        self.assertTrue((self.out / (rows[6]["folder"] + ".failed") / "log.txt").exists())
        self.assertIn("8 cases, 1 of them to compute", self.solve(text, code=1))
        self.assertIn("7 cases, 0 of them to compute", self.solve(text.replace('"1.7 m", ', "")))

    @slow
    def test_two_different_studies_on_one_folder_do_not_both_end_well(self):
        for _ in range(2):
            first, second = (self.start(text, "--jobs", "1") for text in (GRID, GRID.replace('"1.5 mm"', '"1.4 mm"')))
            ends = [(process.communicate()[1], process.returncode) for process in (first, second)]
            bad = [err for err, rc in ends if rc != 0]
            whole = [r["state"] for r in self.rows()] == ["done"] * 6
            self.assertTrue(bad or whole, ends)
            self.assertTrue(all("another study, with other settings, writes into" in err for err in bad), ends)
            self.assertEqual(self.left_behind(), [])
            self.solve(GRID)
            self.assertEqual([r["state"] for r in self.rows()], ["done"] * 6)
            shutil.rmtree(self.out)

    def test_shards_share_the_work_and_the_last_has_the_whole_table(self):
        self.assertIn("2 cases, 2 of them to compute", self.solve(GRID, "--shard", "1/3"))
        self.assertEqual([r["state"] for r in self.rows()], ["done", "to do", "to do", "done", "to do", "to do"])
        first = self.stamps()
        self.solve(GRID, "--shard", "2/3"), self.solve(GRID, "--shard", "3/3")
        self.assertEqual([r["state"] for r in self.rows()], ["done"] * 6)
        self.assertEqual({k: v for k, v in self.stamps().items() if k in first}, first)

    @slow
    def test_studies_that_start_at_once_share_a_folder(self):
        alone = self.folder / "alone"
        rc, _, err = railstrata("study", self.study(GRID), "--out", alone, "--no-report")
        self.assertEqual(rc, 0, err)
        for turn in range(5):
            for shards in ([], [], []), (["--shard", "1/3"], ["--shard", "2/3"], ["--shard", "3/3"]):
                self.end_well([self.start(GRID, *words) for words in shards])
                self.assertEqual(self.left_behind(), [])
                self.assertEqual(len(self.stamps()), 6)
                if not shards[0]:
                    self.assertEqual(numbers(self.rows()), numbers(table(alone / "study.csv")))
                shutil.rmtree(self.out)

    @slow
    def test_what_decides_a_result_decides_whether_it_is_computed_again(self):
        self.solve(GRID)
        before = self.stamps()
        self.assertIn("6 cases, 0 of them to compute",
                      self.solve(GRID.replace('title = "tests"', 'title = "other"').replace("1.5, 2", "1.50, 2.0")))
        self.assertEqual(self.stamps(), before)
        self.assertIn("6 cases, 6 of them to compute", self.solve(GRID.replace('cell = "1.5 mm"', 'cell = "1.4 mm"')))
        self.assertIn("6 cases, 6 of them to compute", self.solve(GRID, "--set", "drive.friction_coefficient=0.4"))
        self.assertIn("9 cases, 9 of them to compute",
                      self.solve(GRID.replace('["1 mm", "2 mm"]', '["1 mm", "2 mm", "3 mm"]')))
        self.assertIn("9 cases, 3 of them to compute",
                      self.solve(GRID.replace('["1 mm", "2 mm"]',
                                              '["1 mm", "2 mm", "3 mm"]').replace("1.5, 2, 4", "1.5, 2, 5")))
        self.assertEqual(self.left_behind(), [])

    def test_a_dry_run_lists_and_computes_nothing(self):
        rc, out, err = railstrata("study", self.study(GRID), "--out", self.out, "--dry-run", "--json")
        self.assertEqual(rc, 0, err)
        self.assertEqual([r["state"] for r in json.loads(out)], ["to do"] * 6)
        self.assertFalse(self.out.exists())
        self.assertIn("6 cases, 6 to compute", err)


    def listed(self, *words):
        rc, out, err = railstrata("study", self.study(GRID), "--out", self.out, *words)
        self.assertEqual(rc, 0, err)
        return out

    def test_the_list_names_each_case_with_its_command_and_only_computes_it(self):
        lines = self.listed("--list", "--json").splitlines()
        cases = json.loads("\n".join(lines))
        self.assertEqual([json.loads(line.strip("[],")) for line in lines], cases, "a case a line")
        self.assertEqual([(c["index"], c["engine"], c["state"]) for c in cases],
                         [(i, "bem", "to do") for i in range(1, 7)])
        self.assertTrue(all(0 < c["seconds"] < 60 and 1e6 < c["memory_bytes"] < 1e9 for c in cases), cases)
        self.assertFalse(self.out.exists())
        words = shlex.split(cases[3]["command"])
        self.assertEqual(words[0], "railstrata")
        rc, _, err = railstrata(*words[1:])
        self.assertEqual(rc, 0, err)
        done = json.loads(self.listed("--list", "--json"))
        self.assertEqual([c["state"] for c in done], ["to do"] * 3 + ["done"] + ["to do"] * 2)
        self.assertEqual([c["key"] for c in done], [c["key"] for c in cases])
        self.assertIsNone(done[3]["seconds"])
        self.refused(2, ["study", self.study(GRID), "--out", self.out, "--only", "7"], "--only 7: the study has 6",
                     "--list gives their indices")
        self.refused(2, ["study", self.study(GRID), "--out", self.out, "--only", "2", "--engine", "fem"],
                     "--only 2: --engine, --group or --shard leave this case out")

    def test_the_batch_script_is_one_for_a_shell(self):
        script = self.listed("--batch", "slurm", "--threads", "2", "--set", "drive.friction_coefficient=0.4")
        for line in ("#SBATCH --array=0\n", "#SBATCH --cpus-per-task=2\n", "#SBATCH --mem=512M\n",
                     "#SBATCH --time=00:15:00\n", "#SBATCH --signal=B:TERM@60\n", "#SBATCH --requeue\n",
                     "#SBATCH --open-mode=append\n"):
            self.assertIn(line, script)
        job = self.pretended_job(0)
        done = subprocess.run(["sh", "-c", script], env=job, capture_output=True, text=True, timeout=300)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual({r["state"] for r in self.rows()}, {"done"})
        self.assertFalse((self.folder / "requeued").exists())

    def test_the_batch_script_of_a_part_computes_that_part(self):
        text = GRID + GRID[GRID.index("[[group]]"):].replace('"grid"', '"other"').replace("[1.5, 2, 4]", "[3]")
        rc, script, err = railstrata("study", self.study(text), "--out", self.out, "--batch", "slurm", "--group",
                                     "other")
        self.assertEqual(rc, 0, err)
        done = subprocess.run(["sh", "-c", script], env=self.pretended_job(0), capture_output=True, text=True,
                              timeout=300)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual([r["state"] for r in self.rows()], ["to do"] * 6 + ["done"] * 2)


class Paper(FromOutside):
    def test_the_study_has_every_thickness_with_every_stiffness(self):
        folder = SOURCE / "cases/paper"
        rc, out, err = railstrata("study", folder / "study.toml", "--out", self.folder / "none", "--dry-run", "--json")
        self.assertEqual(rc, 0, err)
        cases = [(c["engine"], f"{c['group']}/{c['case']}") for c in json.loads(out)]
        self.assertEqual(len(cases), len(set(cases)))
        grid = [(c["values"].get("layer.0.thickness"), c["values"].get("layer.0.young_ratio")) for c in json.loads(out)
                if c["group"] == "layers" and c["engine"] == "fem"]
        self.assertEqual(grid, [(h, e) for h in ("0.2 mm", "0.5 mm", "1 mm", "3 mm", "6 mm")
                                for e in ("1.67", "2", "4")])


class Killed(StudyTest):
    LONG = TINY.replace('positions = ["30 mm"]', 'positions = ["900 mm"]')
    WHEEL = SMALL.replace('["6 mm", "12 mm"]', '["24 mm"]')
    WHEELS = ('[study]\nbase = "case.toml"\nengines = ["fem"]\n[[group]]\nname = "wheel"\n[group.vary]\n'
              '"drive.traction_coefficient" = [0.1, 0.2]\n')

    def working(self):
        return [folder for folder in self.out.rglob("*.part-*") if folder.is_dir()]

    def rolling(self, process):
        """Folders of this study's cases that roll: from then on a signal asks for a checkpoint."""
        with contextlib.suppress(FileNotFoundError):  # one has just been renamed
            return [folder for folder in self.working() if folder.name.endswith(f"-{process.pid}")
                    and (folder / "history.csv").exists() and "meshing" in (folder / "log.txt").read_text()]
        return []

    def wait_until_rolling(self, process):
        end = time.monotonic() + 60
        while time.monotonic() < end and process.poll() is None and not self.rolling(process):
            time.sleep(0.005)

    def goes_on(self):
        """The logs of cases that went on from a checkpoint."""
        return [log for log in self.out.rglob("log.txt") if "goes on in" in log.read_text()]

    def wait_for_a_checkpoint(self, process):
        # a study passes it on; of cases that have gone on there is a checkpoint already
        process.send_signal(signal.SIGUSR1)
        end = time.monotonic() + 60
        while time.monotonic() < end and process.poll() is None and not any((folder / "checkpoint.h5").exists()
                                                                            for folder in self.rolling(process)):
            time.sleep(0.005)

    def finite_element_results(self, out):
        return {str(file.parent.relative_to(out)): results(file.parent) for file in out.rglob("study.json")}

    def assert_same(self, expected):
        found = self.finite_element_results(self.out)
        self.assertEqual({case: sorted(files) for case, files in found.items()},
                         {case: sorted(files) for case, files in expected.items()})
        for case, files in expected.items():
            for name, content in files.items():
                self.assertTrue(found[case][name] == content, f"{case}/{name}")

    def uninterrupted(self, text):
        out = self.folder / "uninterrupted"
        self.rc, _, err = railstrata("study", self.study(text), "--out", out, "--no-report", "--threads", "1")
        self.assertIn(self.rc, (0, 1), err)  # a check of so coarse a rolling may fail
        return self.finite_element_results(out)

    def test_kill_9_of_finite_element_cases_costs_what_they_did_since_their_checkpoints(self):
        self.case(self.WHEEL)
        expected, chance, kills, resumed = self.uninterrupted(self.WHEELS), random.Random(7), 0, 0
        while kills < KILLS:
            process = self.start(self.WHEELS, "--jobs", "2")
            self.wait_until_rolling(process)
            self.wait_for_a_checkpoint(process)
            time.sleep(chance.uniform(0, 0.3))
            if process.poll() is None:  # often it dies while it writes the next
                process.send_signal(signal.SIGUSR1)
            time.sleep(chance.uniform(0, 0.1))
            children = self.children(process) if process.poll() is None else []
            kills += process.poll() is None
            process.kill(), process.communicate()
            self.assertTrue(self.gone(children))
            resumed += sum(".part-" in str(log) for log in self.goes_on())
            for file in self.out.rglob("study.json"):
                self.assertEqual([name for name in broken_files(file.parent) if name != "log.txt"], [])
            if not self.working():  # both done before the next kill: once more
                resumed += len(self.goes_on())
                self.assert_same(expected)
                shutil.rmtree(self.out)
        self.solve(self.WHEELS, code=self.rc)
        resumed += len(self.goes_on())
        self.assertGreater(resumed, 0)
        self.assertEqual(self.left_behind(), [])
        self.assert_same(expected)
        fact("study_fem_killed", kills=kills, resumed=resumed, cases=len(expected))

    @slow
    def test_a_checkpoint_of_another_case_or_a_damaged_one_is_not_gone_on_from(self):
        self.case(self.WHEEL)
        text = self.WHEELS.replace("0.1, 0.2", "0.1")
        expected = self.uninterrupted(text)
        for damage in (lambda file: file.write_bytes(file.read_bytes()[:-1]), None):
            if damage is None:
                self.case(self.LONG)
            process = self.start(text, "--threads", "1")
            self.wait_until_rolling(process)
            self.wait_for_a_checkpoint(process)
            process.send_signal(signal.SIGINT)
            process.communicate()
            self.assertEqual(process.returncode, 130)
            if damage:
                for file in self.out.rglob("checkpoint.h5*"):
                    damage(file)
            else:
                self.case(self.WHEEL)
            self.solve(text, "--threads", "1", code=self.rc)
            self.assertEqual(self.goes_on(), [])
            self.assertEqual(self.left_behind(), [])
            self.assert_same(expected)
            shutil.rmtree(self.out)

    @slow
    def test_two_studies_that_start_after_a_kill_do_not_share_a_checkpoint(self):
        self.case(self.WHEEL)
        text = self.WHEELS.replace("0.1, 0.2", "0.1")
        expected = self.uninterrupted(text)
        process = self.start(text, "--threads", "1")
        self.wait_until_rolling(process)
        self.wait_for_a_checkpoint(process)
        process.send_signal(signal.SIGINT)
        process.communicate()
        self.end_well([self.start(text, "--threads", "1") for _ in range(2)], code=self.rc)
        self.assertEqual(self.left_behind(), [])
        self.assert_same(expected)

    def children(self, process):
        return [int(pid)
                for pid in pathlib.Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text().split()]

    def wait_for_a_child(self, process):
        end = time.monotonic() + 30
        while time.monotonic() < end and not self.children(process):
            time.sleep(0.002)
        return self.children(process)

    def gone(self, pids):
        """Whether they have ended; one that nobody has waited for yet stays as a zombie."""
        def runs(pid):
            try:
                return pathlib.Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
            except (FileNotFoundError, ProcessLookupError):
                return False
        end = time.monotonic() + 30
        while any(map(runs, pids)):
            if time.monotonic() > end:
                return False
            time.sleep(0.01)
        return True

    @slow
    def test_kill_9_at_any_moment_neither_redoes_nor_loses_a_case(self):
        text = GRID.replace('cell = "1.5 mm"', 'cell = "0.6 mm"')
        chance, kept = random.Random(5), {}
        for _ in range(KILLS * 3 // 2):
            process = self.start(text, "--jobs", "2")
            time.sleep(chance.uniform(0.05, 0.5))
            children = self.children(process)
            process.send_signal(signal.SIGKILL)
            process.communicate()
            self.assertEqual(children, [], "half-space cases are threads of the study")
            now = self.stamps()
            self.assertEqual({k: now.get(k) for k in kept}, kept, "a finished case has been lost or done again")
            kept = now
            for name in now:
                folder = (self.out / name).parent
                json.loads((folder / "summary.json").read_text()), (folder / "patch.csv").read_text()
        self.solve(text)
        rows = self.rows()
        self.assertEqual([r["state"] for r in rows], ["done"] * 6)
        self.assertEqual({k: v for k, v in self.stamps().items() if k in kept}, kept)
        self.assertEqual(self.left_behind(), [])
        fact("study_bem_killed", kills=KILLS * 3 // 2, cases=len(rows))
        uninterrupted = self.folder / "uninterrupted"
        rc, _, err = railstrata("study", self.folder / "study.toml", "--out", uninterrupted, "--no-report")
        self.assertEqual(rc, 0, err)
        self.assertEqual(numbers(rows), numbers(table(uninterrupted / "study.csv")))

    def test_a_result_that_was_whole_when_the_study_died_is_taken(self):
        self.solve(GRID)
        place = self.out / self.rows()[0]["folder"]
        dead = subprocess.Popen(["true"])
        dead.wait()
        os.rename(place, f"{place}.part-{os.uname().nodename}-{dead.pid}")
        stamps = {file.stat().st_mtime_ns for file in self.out.rglob("study.json")}
        self.assertIn("6 cases, 0 of them to compute", self.solve(GRID))
        self.assertEqual(set(self.stamps().values()), stamps)
        self.assertEqual(self.left_behind(), [])

    def test_a_case_that_is_killed_is_a_line_with_its_reason(self):
        self.case(TINY.replace('positions = ["30 mm"]', 'positions = ["900 mm"]'))
        process = self.start('[study]\nbase = "case.toml"\nengines = ["fem"]\n[[group]]\nname = "wheel"\n')
        os.kill(self.wait_for_a_child(process)[0], signal.SIGKILL)
        process.communicate(timeout=60)
        self.assertEqual(process.returncode, 1)
        self.assertEqual(self.rows()[0]["fault"], "killed by signal 9 (Killed)")

    def test_ctrl_c_stops_in_time_and_keeps_what_is_there(self):
        self.case(self.LONG)
        text = GRID + '[[group]]\nname = "long"\nbase = "case.toml"\nengines = ["fem"]\n'
        process = self.start(text, "--jobs", "1", start_new_session=True)
        end = time.monotonic() + 60
        while time.monotonic() < end and len(self.stamps()) < 6:
            time.sleep(0.02)
        child = self.wait_for_a_child(process)
        self.wait_until_rolling(process)
        asked = time.monotonic()
        # a terminal asks all of them, the study its cases once more, a batch system too
        os.killpg(process.pid, signal.SIGINT)
        for pid in child:
            os.kill(pid, signal.SIGTERM)
        _, err = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130, err)
        self.assertLess(time.monotonic() - asked, 25)
        self.assertTrue(self.gone(child))
        self.assertIn("goes on where it was", err)
        self.assertEqual([(r["state"], r["fault"]) for r in self.rows()], [("done", "")] * 6 + [("to do", "")])
        left, = self.left_behind()
        self.assertTrue((pathlib.Path(left) / "checkpoint.h5").exists())
        process = self.start(text, "--jobs", "1")
        end = time.monotonic() + 60
        while time.monotonic() < end and "goes on in" not in "".join((folder / "log.txt").read_text()
                                                                     for folder in self.working()
                                                                     if (folder / "log.txt").exists()):
            time.sleep(0.02)
        process.kill(), process.communicate()
        self.assertEqual(len(self.goes_on()), 1)


    def test_a_batch_job_that_is_told_to_stop_puts_itself_into_the_queue_again(self):
        self.case(self.LONG)
        text = '[study]\nbase = "case.toml"\nengines = ["fem"]\n[[group]]\nname = "wheel"\n'
        rc, script, err = railstrata("study", self.study(text), "--out", self.out, "--batch", "slurm")
        self.assertEqual(rc, 0, err)
        self.assertIn("#SBATCH --array=1\n", script)
        job = subprocess.Popen(["sh", "-c", script], env=self.pretended_job(1))
        study = self.wait_for_a_child(job)[0]
        end = time.monotonic() + 60
        while time.monotonic() < end and not list(self.out.rglob("history.csv")):
            time.sleep(0.02)
        job.terminate()
        self.assertEqual(job.wait(60), 130)
        self.assertTrue(self.gone([study]))
        self.assertEqual((self.folder / "requeued").read_text(), "requeue 7_1\n")


class Refused(StudyTest):
    def test_values_that_cases_refuse_are_told_at_their_place_in_the_study(self):
        file = self.study(GRID.replace("[1.5, 2, 4]", "[1.5, 2000]").replace('"layer.0.thickness"',
                                                                             '"layer.0.thicknes"'))
        self.refused(2, ["study", file, "--out", self.out], f"{file}:10:23: error: unknown key layer.0.thicknes",
                     "did you mean thickness?", f"{file}:11:31: error: layer.0.young_ratio = 2000: must be between")
        self.refused(2, ["study", self.study(GRID + '"layer.2.width" = ["60 mm"]\n'), "--out", self.out],
                     f"{file}:12:20: error: layer.2.width: layer has 1 entry, counted from 0; layer.1 adds one")
        self.assertFalse(self.out.exists())

    def test_words_that_make_no_sense(self):
        file = self.study(GRID)
        self.refused(2, ["study", file, "--shard", "3/2"], "--shard 3/2: is not i/n", "remedy: write --shard 2/8")
        self.refused(2, ["study", file, "--engine", "fme"], "--engine")
        self.refused(2, ["study", file, "--group", "gird"], "the study has no such group", "groups: grid")
        self.refused(2, ["study", self.folder / "none.toml"], "cannot read")

    def test_a_folder_with_other_things_is_left_alone(self):
        self.out.mkdir()
        (self.out / "precious").write_text("")
        self.refused(2, ["study", self.study(GRID), "--out", self.out], "is not empty", "--force")


if __name__ == "__main__":
    main(*sys.argv[4:])
