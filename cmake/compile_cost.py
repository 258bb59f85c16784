#!/usr/bin/env python3
"""What a compiler needs: user seconds and peak memory (MB) of one run.

    python3 cmake/compile_cost.py LIMIT_MB COMMAND...    fails when COMMAND fails or its peak memory is above the limit
"""
import os
import shutil
import sys

# g++ collects its garbage by the machine's memory; these are its own figures for 1 GB and more.
STEADY = ["--param", "ggc-min-expand=100", "--param", "ggc-min-heapsize=131072"]


def cost(command):
    """User seconds and MB of the largest process; leaves the program when the command fails."""
    if "g++" in os.path.basename(command[0]) and "clang" not in command[0]:
        command = [command[0], *STEADY, *command[1:]]
    child = os.posix_spawn(shutil.which(command[0]) or sys.exit(f"no {command[0]}"), command, os.environ)
    _, status, usage = os.wait4(child, 0)
    if status != 0:
        sys.exit(f"{' '.join(command)}: exit code {os.waitstatus_to_exitcode(status)}")
    return usage.ru_utime, usage.ru_maxrss / 1024


if __name__ == "__main__":
    limit, command = float(sys.argv[1]), sys.argv[2:]
    seconds, memory = cost(command)
    print(f"{seconds:.1f} s, {memory:.0f} MB of at most {limit:.0f}: {command[-1]}")
    sys.exit(f"{memory:.0f} MB is above the limit" if memory > limit else 0)
