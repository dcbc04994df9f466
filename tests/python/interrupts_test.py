# SPDX-License-Identifier: Apache-2.0
"""Ctrl-C, and a progress function that raises: what was searched is saved, and goes on to the identical result."""
import json
import os
import signal
import subprocess
import sys
import threading

import tunica
from support import TRELOAR, Case, of_treloar, result_of

# Some seconds of evaluations: whatever the machine, a signal at the first word of progress comes in the middle.
LONG = of_treloar({"type": "ogden", "terms": 3}, {"type": "es"}, 400000)
SHORT_LAST = {**LONG, "name": "short", "stop": {"max_evaluations": 60000}}


class Interrupts(Case):
    def interrupt_in(self, call, trigger):
        """Runs `call` and presses Ctrl-C where it first tells its progress."""
        pressed = []

        def progress(share, text):
            if not pressed:
                pressed.append(share)
                trigger()
        with self.assertRaises(tunica.Interrupted) as raised:
            call(progress)
        self.assertTrue(pressed)
        return raised.exception

    def test_an_interrupted_run_is_resumed_to_the_identical_result(self):
        whole = tunica.run(SHORT_LAST, self.folder / "whole", base=TRELOAR, threads=1)
        raised = self.interrupt_in(
            lambda progress: tunica.run(SHORT_LAST, self.folder / "part", base=TRELOAR, threads=1, progress=progress),
            lambda: os.kill(os.getpid(), signal.SIGINT))
        self.assertIsInstance(raised, KeyboardInterrupt)
        self.assertEqual(str(self.folder / "part"), raised.directory)
        self.assertIn("resume=True", str(raised))
        self.assertFalse((self.folder / "part" / "result.json").exists())
        resumed = tunica.run(SHORT_LAST, self.folder / "part", base=TRELOAR, threads=1, resume=True)
        self.assertEqual(result_of(whole.directory), result_of(resumed.directory))

    def test_a_killed_run_of_a_definition_is_resumed_to_the_identical_result(self):
        (self.folder / "mine.py").write_text(
            "import sys, tunica\n"
            "@tunica.model('mine', {'c10': ('kPa', 100, 0, 1000), 'c01': ('kPa', 10, 0, 1000)})\n"
            "def energy(C, c10, c01):\n"
            "    return c10 * (C.I1 - 3) + c01 * (C.I2 - 3)\n"
            "experiment, folder, resume = sys.argv[1:]\n"
            "tunica.run(experiment, folder, resume=resume == 'yes', certificate=False)\n")
        experiment = of_treloar({"type": "mine"}, {"type": "es"}, 3000)
        for test in experiment["tests"].values():
            test["data"]["file"] = str(TRELOAR / test["data"]["file"])
        (self.folder / "experiment.json").write_text(json.dumps(experiment))

        def start(folder, resume="no"):
            return subprocess.Popen([sys.executable, "-B", "mine.py", "experiment.json", folder, resume],
                                    cwd=self.folder)
        killed = start("killed")
        table = self.folder / "killed" / "evaluations.csv"
        while not table.exists() or table.stat().st_size < 20000:
            self.assertIsNone(killed.poll(), "the run ended before it could be killed")
        killed.kill()
        killed.wait()
        for folder, resume in (("killed", "yes"), ("whole", "no")):
            self.assertEqual(0, start(folder, resume).wait())
        self.assertEqual(result_of(self.folder / "whole"), result_of(self.folder / "killed"))
        self.assertEqual(3000, tunica.open(self.folder / "killed").evaluations.rows)

    def test_signals_do_afterwards_what_they_did_before(self):
        before = signal.getsignal(signal.SIGINT)
        tunica.run(of_treloar({"type": "neo_hooke"}), self.folder / "run", base=TRELOAR)
        self.assertIs(before, signal.getsignal(signal.SIGINT))
        with self.assertRaises(KeyboardInterrupt):
            os.kill(os.getpid(), signal.SIGINT)
            threading.Event().wait(10)

    def test_what_progress_raises_ends_the_run_and_is_raised_again(self):
        def progress(share, text):
            raise RuntimeError("enough")
        with self.assertRaisesRegex(RuntimeError, "enough"):
            tunica.run(LONG, self.folder / "run", base=TRELOAR, progress=progress)
        self.assertTrue((self.folder / "run" / "evaluations.csv").exists())

    def test_an_interrupted_diagnosis_leaves_nothing(self):
        raised = self.interrupt_in(
            lambda progress: tunica.diagnose(TRELOAR.parent / "treloar_cause" / "experiment.json",
                                             self.folder / "diagnosis", progress=progress),
            lambda: os.kill(os.getpid(), signal.SIGINT))
        self.assertIsNone(raised.directory)
        self.assertEqual([], list(self.folder.iterdir()))

    def test_two_runs_at_a_time_are_refused(self):
        met = []

        def progress(share, text):
            if not met:
                with self.assertRaises(tunica.InputError) as raised:
                    tunica.run(LONG, self.folder / "second", base=TRELOAR)
                met.append(str(raised.exception))
                raise RuntimeError("enough")
        with self.assertRaisesRegex(RuntimeError, "enough"):
            tunica.run(LONG, self.folder / "first", base=TRELOAR, progress=progress)
        self.assertIn("another run", met[0])
