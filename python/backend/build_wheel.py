"""Makes the wheel of `pip install .` (PEP 517) with nothing but Python, CMake and what scripts/packages.txt names.

Builds into build/python; what was compiled there before is not compiled again.
"""
import base64
import hashlib
import os
import subprocess
import sys
import sysconfig
import tomllib
import zipfile

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
BUILD = os.path.join(ROOT, "build", "python")


def _project():
    with open(os.path.join(ROOT, "pyproject.toml"), "rb") as file:
        return tomllib.load(file)["project"]


def _tag():
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    return f"{python}-{python}-{sysconfig.get_platform().replace('-', '_').replace('.', '_')}"


def _compile():
    """The package's folder."""
    os.makedirs(BUILD, exist_ok=True)
    try:
        subprocess.run(["cmake", "-S", ROOT, "-B", BUILD, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_UNITY_BUILD=ON",
                        "-DBUILD_TESTING=OFF", f"-DPython_EXECUTABLE={sys.executable}"], check=True)
        subprocess.run(["cmake", "--build", BUILD, "--parallel", str(os.cpu_count() or 1), "--target", "python_package"], check=True)
    except FileNotFoundError as error:
        raise SystemExit(f"{error.filename}: not there. Install the packages of scripts/packages.txt and python/packages.txt.") from error
    except subprocess.CalledProcessError as error:
        raise SystemExit("the package could not be built, see above. Are the packages of scripts/packages.txt and python/packages.txt "
                         "installed?") from error
    return os.path.join(BUILD, "python", "splashdown")


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    """PEP 517."""
    project = _project()
    package = _compile()
    info = f"{project['name']}-{project['version']}.dist-info"
    name = f"{project['name']}-{project['version']}-{_tag()}.whl"
    record = []
    with zipfile.ZipFile(os.path.join(wheel_directory, name), "w", zipfile.ZIP_DEFLATED) as wheel:

        def add(path, data, mode=0o644):
            entry = zipfile.ZipInfo(path)
            entry.external_attr = (0o100000 | mode) << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            wheel.writestr(entry, data)
            digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
            record.append(f"{path},sha256={digest},{len(data)}")

        for file in sorted(os.listdir(package)):
            if file == "__pycache__":
                continue
            with open(os.path.join(package, file), "rb") as bytes_:
                add(f"splashdown/{file}", bytes_.read(), 0o755 if file == "splashdown" else 0o644)
        add(f"{info}/METADATA", (f"Metadata-Version: 2.1\nName: {project['name']}\nVersion: {project['version']}\n"
                                 f"Summary: {project['description']}\nRequires-Python: {project['requires-python']}\n").encode())
        add(f"{info}/WHEEL", f"Wheel-Version: 1.0\nGenerator: splashdown\nRoot-Is-Purelib: false\nTag: {_tag()}\n".encode())
        wheel.writestr(f"{info}/RECORD", "\n".join([*record, f"{info}/RECORD,,"]) + "\n")
    return name


def build_sdist(sdist_directory, config_settings=None):
    """PEP 517: there is none."""
    raise NotImplementedError("splashdown is installed from its source tree: pip install .")
