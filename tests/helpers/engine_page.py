"""A page that has loaded the engine for a browser, and scenarios and releases as it takes them."""

import json
from base64 import b64encode
from pathlib import Path

from cointoss.compare.web import wasm
from cointoss.compare.web.scripts import ENGINE_POLICY, files_of, import_map
from cointoss.compare.web.wasm.carried import engine_scripts
from cointoss.models.batch import STATE
from cointoss.models.rows import fields_of

ENGINE = Path(wasm.__file__).parent / "engine.wasm"


def engine_page() -> str:
    """Return a page of one file whose window has the engine, its workers, the scenario's fields, and how to
    start others; all scripts of the lab can be imported."""
    engine = b64encode(ENGINE.read_bytes()).decode()
    files = {**files_of("cointoss.compare.lab"), **engine_scripts()}
    scripts = import_map({name: text.decode() for name, text in files.items() if name.endswith(".js")})
    return f"""<!doctype html><meta charset="utf-8">
        <meta http-equiv="Content-Security-Policy" content="{ENGINE_POLICY}"><title>engine</title><body>
        {scripts}<script type="module">
        import {{ load }} from "engine.js";
        import {{ startWorkers }} from "workers.js";
        const bytes = Uint8Array.from(atob("{engine}"), (c) => c.charCodeAt(0));
        const message = async (ask) => {{
          try {{ await ask(); }} catch (error) {{ return error.message; }}
        }};
        const workers = await startWorkers(bytes);
        const {{ engine }} = workers;
        const fields = Object.fromEntries(engine.about.fields.map((field) => [field.name, field]));
        Object.assign(window, {{ load, bytes, message, startWorkers, workers, engine, fields }});
        document.body.dataset.ready = "true";
        </script>"""


def written(case):
    """Return a scenario as the page takes it, as JavaScript."""
    return json.dumps(fields_of(case))


def changes(states):
    """Return states at release, (n, 13), as values of fields, as JavaScript."""
    return json.dumps(dict(zip(STATE, states.T.tolist(), strict=True)))
