"""The program of a commit, or of this tree."""

import shutil
import subprocess
import sys


def built(root, place, commit):
    """The path of its release program; that of a commit is built once."""
    target = place / "target"
    if commit is None:
        print("== building this tree", file=sys.stderr)
        cargo(root / "Cargo.toml", target)
        return keep(target, place / "trueaxis-now")
    number = git(root, "rev-parse", "--verify", f"{commit}^{{commit}}")
    kept = place / f"trueaxis-{number}"
    if kept.exists():
        return kept
    tree = place / "tree"
    git(root, "worktree", "prune")
    if not tree.is_dir():
        git(root, "worktree", "add", "--detach", "--quiet", str(tree), number)
    git(tree, "checkout", "--detach", "--quiet", "--force", number)
    print(f"== building {commit}", file=sys.stderr)
    cargo(tree / "Cargo.toml", target)
    return keep(target, kept)


def cargo(manifest, target):
    subprocess.run(
        ["cargo", "build", "--release", "--locked", "--quiet", "--no-default-features"]
        + ["--bin", "trueaxis", "--manifest-path", manifest, "--target-dir", target],
        check=True,
    )


def keep(target, path):
    shutil.copy2(target / "release/trueaxis", path)
    return path


def git(where, *words):
    done = subprocess.run(["git", "-C", where, *words], check=True, capture_output=True, text=True)
    return done.stdout.strip()
