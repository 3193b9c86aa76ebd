"""Answers to numbers of steps, a line of JSON each, as crates/xtask/src/bench/peers.rs asks."""

import json
import os
import sys
import time

# What the programs print is none of the answers.
ANSWERS = os.fdopen(os.dup(1), "w")
os.dup2(os.open(os.devnull, os.O_WRONLY), 1)


def serve(prepare):
    """`prepare(steps)` makes the model ready and returns two functions: one that runs it and says
    whether it succeeded, which is timed, and one that reads the numbers at the end."""
    for line in sys.stdin:
        try:
            answer = timed(*prepare(int(line)))
        except Exception as error:  # whatever it is, the next number of steps may succeed
            answer = {"failure": str(error).strip().splitlines()[-1] if str(error).strip() else
                      type(error).__name__}
        print(json.dumps(answer), file=ANSWERS, flush=True)


def timed(run, read):
    wall, processor = time.perf_counter(), time.process_time()
    succeeded = run()
    times = {"processor": time.process_time() - processor, "wall": time.perf_counter() - wall}
    if not succeeded:
        return {"failure": "the solver gave up"}
    return {**times, "values": [float(value) for value in read()]}
