#!/bin/sh
# Makes made/ anew from given/ by the cointoss that is on the PATH: what this release writes.
set -e
cd "$(dirname "$0")/given"
rm -rf ../made
mkdir ../made

for scenario in smooth coulomb sharp_edge knurled perfectly_rough slip_preserving sliding_friction caught dropped worn viscous; do
  cointoss toss $scenario.toml --json > ../made/$scenario.json
done
cointoss toss caught.toml --trajectory ../made/caught.csv > /dev/null
cointoss hands smooth.toml --hand hand.toml --tosses 40 --json > ../made/hand.json
cointoss hands smooth.toml --hand spun.toml --tosses 40 --json > ../made/spun.json
cointoss shares dropped.toml --vary floor.restitution=0.3:0.6:2 --psi-scatter 0 --tosses 40 --json > ../made/shares.json
cointoss shares dropped.toml --vary floor.restitution=0.3:0.6:2 --psi-scatter 0 --tosses 40 --out ../made/shares.csv
cointoss fit stopwatch.csv dropped.toml --sd-time "1 ms" --vary floor.restitution=0.4:0.95 \
  --vary release.position.z=0.1:0.6 --vary clock=0:1.2 --out ../made/fitted.toml --json > ../made/fit.json
cointoss find smooth.toml --sequence HTH --vary release.position.z=0.2:0.6 --tosses 200 --out ../made/found.toml --json \
  > ../made/find.json
axes="--x release.angular_velocity.eta=20:60:4 --y release.position.z=20cm:60cm:3"
cointoss basin smooth.toml $axes --after 1 --margin height --trust --out ../made/touch.zarr
cointoss basin dropped.toml $axes --trust --out ../made/final.zarr
cointoss basin dropped.toml $axes --engine mujoco --contact one_step --after 0 --out ../made/mujoco.zarr
python - << 'END'
import json
from pathlib import Path

import cointoss
import numpy as np
import xarray
from cointoss.compare.fitting.table import read_seen
from cointoss.models.batch import STATE
from cointoss.models.fields import UNITS
from cointoss.models.laws import ContactLaw, EndingTest, RestitutionKind

rng, coin = np.random.default_rng(0), cointoss.load("dropped.toml")
states = np.concatenate([cointoss.Hand().states(coin.body, rng, 4) for _ in range(2)])
cointoss.toss_many(coin, dict(zip(STATE, states.T, strict=True)), trust="certain", out="../made/tosses.zarr")


def words(array):
    """Return the values of an array, as words where they mean one."""
    if "flag_values" not in array.attrs:
        return array.values.tolist()
    meanings = dict(zip(array.attrs["flag_values"], array.attrs["flag_meanings"].split()))
    return np.vectorize(meanings.get)(array.values).tolist()


for store in Path("../made").glob("*.zarr"):
    with xarray.open_zarr(store, consolidated=False) as found:
        read = {str(name): words(array) for name, array in found.variables.items()}
    store.with_suffix(".json").write_text(json.dumps(read, indent=1))
for table in ("stopwatch", "frames"):
    seen = read_seen(f"{table}.csv", {"time": 0.001, "height": 0.002, "attitude": 0.01})
    read = {name: getattr(seen, name).tolist() for name in seen.__dataclass_fields__}
    Path(f"../made/{table}.json").write_text(json.dumps(read, indent=1))
fields = {".".join(field.split(".")[:2]) for field in UNITS} | {"coin.inertia"}
choices = {"floor.contact": ContactLaw, "floor.restitution_kind": RestitutionKind, "ending.test": EndingTest}
accepted = {field: [] for field in fields} | {field: [str(each) for each in kind] for field, kind in choices.items()}
Path("../made/fields.json").write_text(json.dumps(dict(sorted(accepted.items())), indent=1))
END
