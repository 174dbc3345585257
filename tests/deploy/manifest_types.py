"""Manifests against Kubernetes' API: TypeScript's compiler holds them against types that npm's
kubernetes-types has from the API's OpenAPI schemas.

Unknown and missing keys and wrong types are found; of values only their type is looked at.
"""

import json
import shutil
import subprocess
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
MODULES = HERE.parents[1] / "client-web/node_modules"
COMPILER = MODULES / "typescript/bin/tsc"
TYPES = MODULES / "kubernetes-types"
CUSTOM = {"monitoring.coreos.com/v1", "keda.sh/v1alpha1"}

OPTIONS = {"strict": True, "noEmit": True, "skipLibCheck": True, "module": "ESNext",
           "moduleResolution": "bundler", "target": "ES2022", "types": [],
           "paths": {"kubernetes-types/*": [f"{TYPES}/*"]}}


def available():
    return bool(shutil.which("node")) and COMPILER.exists() and TYPES.exists()


def module_of(api_version):
    """None where there is none."""
    if api_version in CUSTOM:
        return "./custom_resources"
    group, _, version = api_version.rpartition("/")
    name = f"{group.split('.')[0] or 'core'}/{version}"
    return f"kubernetes-types/{name}" if (TYPES / f"{name}.d.ts").exists() else None


def complaints(documents):
    """One line for each thing that the API would not take."""
    found, lines = [], []
    for index, document in enumerate(documents):
        api_version, kind = document.get("apiVersion", ""), document.get("kind", "")
        module = module_of(api_version)
        if module is None or not kind.isidentifier():
            found.append(f"document {index}: no kind \"{kind}\" of \"{api_version}\" is known")
            continue
        # A literal of its own on lines of its own: keys that no type has are errors in literals alone.
        lines.append(f"import type {{ {kind} as T{index} }} from '{module}';\n"
                     f"export const d{index}: T{index} = {json.dumps(document, indent=1)};\n")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "manifests.ts").write_text("".join(lines))
        shutil.copy(HERE / "custom_resources.ts", folder)
        (folder / "tsconfig.json").write_text(json.dumps({"compilerOptions": OPTIONS}))
        run = subprocess.run(["node", COMPILER, "-p", folder], capture_output=True, text=True,
                             check=False, cwd=folder)
    return found + run.stdout.splitlines()
