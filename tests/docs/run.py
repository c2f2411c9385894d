#!/usr/bin/env python3
"""Checks documents: run.py ROOT CHECK…, each of links, changelog, theory, glossary, identifiers, names, mathematics, readmes, gallery. Exit code 1: faults, listed."""
import sys

import changelog
import identifiers
import links
import names
import readme
import theory

CHECKS = {
    "links": links.faults,
    "changelog": changelog.faults,
    "theory": theory.faults,
    "glossary": theory.glossary_faults,
    "identifiers": identifiers.faults,
    "names": names.faults,
    "mathematics": theory.mathematics_faults,
    "readmes": readme.faults,
    "gallery": readme.gallery_faults,
}

if __name__ == "__main__":
    if len(sys.argv) < 3 or any(check not in CHECKS for check in sys.argv[2:]):
        sys.exit(f"run.py ROOT CHECK…; checks: {', '.join(CHECKS)}")
    found = [fault for check in sys.argv[2:] for fault in CHECKS[check](sys.argv[1])]
    print("\n".join(found) or "no fault")
    sys.exit(bool(found))
