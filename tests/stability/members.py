"""Random members of a class, run by the program, one line each. Standard library only."""
import argparse
import os
import subprocess
import sys
import tempfile
import time


def run(binary, text, folder, values=()):
    """Runs a scene with this text and `values` of --set; its folder of results. RuntimeError: how it ended instead."""
    os.makedirs(folder, exist_ok=True)
    scene = os.path.join(folder, "scene.toml")
    with open(scene, "w") as f:
        f.write(text)
    out = os.path.join(folder, "out")
    done = subprocess.run([binary, "run", scene, "--out", out, "--threads", "1", "--quiet", "--no-report", *(a for value in values for a in ("--set", value))],
                          capture_output=True, text=True)
    if done.returncode != 0:
        raise RuntimeError(f"exit {done.returncode}: {done.stderr.strip()[-300:]}")
    return out


def arguments(about, laws):
    """The command line of a class: `about` describes it, `laws` are its kinds."""
    parser = argparse.ArgumentParser(description=about, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("binary")
    parser.add_argument("kind", choices=[law.__name__ for law in laws])
    parser.add_argument("--members", type=int, default=4)
    parser.add_argument("--first", type=int, default=1)
    parser.add_argument("--elements", type=int, default=40, help="on a wave")
    parser.add_argument("--keep")
    return parser


def try_members(options, laws):
    """Each member by law(binary, seed, options, folder), which says whether it holds and how well; never returns. Exit code 1: one breaks it."""
    law = next(law for law in laws if law.__name__ == options.kind)
    folder, broken = options.keep or tempfile.mkdtemp(prefix=f"{options.kind}-"), 0
    print(law.__doc__)
    for seed in range(options.first, options.first + options.members):
        begin = time.time()
        try:
            holds, words = law(options.binary, seed, options, os.path.join(folder, f"{options.kind}-{seed}"))
        except RuntimeError as error:
            holds, words = False, str(error)
        broken += not holds
        print(f"{seed:5d} {'holds ' if holds else 'BROKEN'} {words}; {time.time() - begin:.0f} s", flush=True)
    print(f"{options.members - broken} of {options.members} hold")
    sys.exit(broken > 0)
