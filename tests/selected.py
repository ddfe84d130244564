"""unittest for the scripts of CTest: tests marked @slow apart from the others, and nothing skipped unseen.

    import selected              # before a script reads its arguments: takes --slow from them
    if __name__ == "__main__":
        selected.main()          # with --slow the tests marked so, without it the others
"""
import sys
import unittest

sys.dont_write_bytecode = True
SLOW = "--slow" in sys.argv
if SLOW:
    sys.argv.remove("--slow")


def slow(test):
    """Marks a test, or all of a class: the deeper look at what another test looks at by default."""
    test.slow = True
    return test


class Loader(unittest.TestLoader):
    def getTestCaseNames(self, case):
        return [name for name in super().getTestCaseNames(case)
                if SLOW == (hasattr(case, "slow") or hasattr(getattr(case, name), "slow"))]


def run(*names):
    """The exit code of all tests (of those named, if any are): 77 where each was skipped, 1 where there is none."""
    result = unittest.main(argv=[sys.argv[0], *names], testLoader=Loader(), exit=False, verbosity=2).result
    if result.testsRun and len(result.skipped) == result.testsRun:
        return 77
    return 0 if result.wasSuccessful() and result.testsRun else 1


def main(*names):
    sys.exit(run(*names))
