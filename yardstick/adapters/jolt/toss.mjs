// Tosses a coin by Jolt: reads the toss as JSON from standard input, and prints the states at its steps.
// `node toss.mjs FOLDER`, where FOLDER/node_modules has jolt-physics.
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import { pathToFileURL } from "node:url";

const found = createRequire(join(process.argv[2], "here")).resolve("jolt-physics");
const Jolt = await (await import(pathToFileURL(found))).default();
const toss = JSON.parse(readFileSync(0, "utf-8"));
const vector = (xyz) => new Jolt.Vec3(...xyz);
const place = (xyz) => new Jolt.RVec3(...xyz);
const turn = ([w, x, y, z]) => new Jolt.Quat(x, y, z, w);

function world() {
  const settings = new Jolt.JoltSettings(), layers = new Jolt.ObjectLayerPairFilterTable(1);
  layers.EnableCollision(0, 0);
  const coarse = new Jolt.BroadPhaseLayerInterfaceTable(1, 1);
  coarse.MapObjectToBroadPhaseLayer(0, new Jolt.BroadPhaseLayer(0));
  settings.mObjectLayerPairFilter = layers;
  settings.mBroadPhaseLayerInterface = coarse;
  settings.mObjectVsBroadPhaseLayerFilter = new Jolt.ObjectVsBroadPhaseLayerFilterTable(coarse, 1, layers, 1);
  const jolt = new Jolt.JoltInterface(settings), system = jolt.GetPhysicsSystem();
  system.SetGravity(vector([0, 0, -toss.gravity]));
  const physics = system.GetPhysicsSettings();
  Object.assign(physics, toss.world);
  system.SetPhysicsSettings(physics);
  return [jolt, system.GetBodyInterface()];
}

// Jolt's cylinder lies along y, the coin's axis along z.
function coin() {
  const cylinder = new Jolt.CylinderShapeSettings(toss.thickness / 2, toss.radius, 0);
  const upright = turn([Math.SQRT1_2, Math.SQRT1_2, 0, 0]);
  const shape = new Jolt.RotatedTranslatedShapeSettings(vector([0, 0, 0]), upright, cylinder).Create().Get();
  const made = new Jolt.BodyCreationSettings(
    shape, place(toss.position), turn(toss.quaternion), Jolt.EMotionType_Dynamic, 0);
  made.mOverrideMassProperties = Jolt.EOverrideMassProperties_MassAndInertiaProvided;
  made.mMassPropertiesOverride.mMass = toss.mass;
  made.mMassPropertiesOverride.mInertia = Jolt.Mat44.prototype.sIdentity();
  made.mLinearVelocity = vector(toss.velocity);
  made.mAngularVelocity = vector(toss.spin);
  made.mRestitution = toss.restitution;
  made.mFriction = toss.friction;
  return Object.assign(made, toss.body);
}

function floor() {
  const plane = new Jolt.PlaneShape(new Jolt.Plane(vector([0, 0, 1]), 0), null, 1000);
  const made = new Jolt.BodyCreationSettings(
    plane, place([0, 0, 0]), turn([1, 0, 0, 0]), Jolt.EMotionType_Static, 0);
  made.mFriction = toss.friction;
  return made;
}

const [jolt, bodies] = world();
bodies.CreateAndAddBody(floor(), Jolt.EActivation_DontActivate);
const body = bodies.CreateBody(coin());
// Jolt's own way to the principal moments fails below some 5e-7 kg m^2.
body.GetMotionProperties().SetInverseInertia(vector(toss.inertia.map((J) => 1 / J)), turn([1, 0, 0, 0]));
bodies.AddBody(body.GetID(), Jolt.EActivation_Activate);
const numbers = (of, names) => [...names].map((name) => of[`Get${name}`]());
const rows = [];
let taken = 0;
for (const due of toss.steps) {
  for (; taken < due; taken++) jolt.Step(toss.dt, 1);
  const e = body.GetRotation();
  rows.push([
    ...numbers(body.GetCenterOfMassPosition(), "XYZ"), ...numbers(body.GetLinearVelocity(), "XYZ"),
    ...numbers(e, "WXYZ"), ...numbers(body.GetAngularVelocity(), "XYZ")]);
}
process.stdout.write(JSON.stringify(rows));
