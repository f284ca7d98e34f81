// SPDX-License-Identifier: MIT
// roslib.mjs COMMAND SCENARIO FOLDER: the ROS client roslib against `live --rosbridge`, in simulated time
// that goes on by steps. Prints what holds, a line each.
// roslib.mjs drive URL: a client that drives B until it is killed.
import {Param, Ros, Service, Topic} from "roslib";
import WebSocket from "ws";
import assert from "node:assert/strict";
import {execFileSync, spawn} from "node:child_process";
import {once} from "node:events";
import {createInterface} from "node:readline";
import {fileURLToPath} from "node:url";

const exact = 1e-9;  // m, rad, dB: what the rounding of a few operations leaves
const chord = 1e-3;  // m of a driven robot from its arc

const near = (found, expected, tolerance, what) =>
  assert.ok(Math.abs(found - expected) <= tolerance, `${what}: found ${found}, expected ${expected}`);
const asked = (object, method, ...args) =>
  new Promise((done, fail) => object[method](...args, done, (why) => fail(new Error(why))));
const twist = (v, w) => ({linear: {x: v, y: 0, z: 0}, angular: {x: 0, y: 0, z: w}});
const time = ({sec, nanosec}) => sec + nanosec / 1e9;

async function connected(url) {
  const ros = new Ros({url});
  await once(ros, "connection");
  return ros;
}
const topic = (ros, name, messageType, more = {}) => new Topic({ros, name, messageType, ...more});
function call(ros, name, request = {}) {
  return asked(new Service({ros, name, serviceType: ""}), "callService", request);
}
const step = (ros, seconds) => call(ros, "/simulation/step", {seconds});

// Messages of a topic while `during` runs.
async function messages(subscribed, during) {
  const found = [];
  subscribed.subscribe((message) => found.push(message));
  await during();
  subscribed.unsubscribe();
  return found;
}
const next = (subscribed) => new Promise((done) => subscribed.subscribe((message) => {
  subscribed.unsubscribe();
  done(message);
}));

async function asksWhatThereIs(ros) {
  const {topics, types} = await asked(ros, "getTopics");
  assert.equal(types[topics.indexOf("/A/odom")], "nav_msgs/Odometry");
  assert.equal(types[topics.indexOf("/A/scan")], "sensor_msgs/LaserScan");
  assert.ok(!topics.includes("/B/scan"));
  assert.ok((await asked(ros, "getServices")).includes("/A/radio/send"));
  assert.deepEqual(await asked(ros, "getNodes"), ["/rovernet"]);
  assert.equal(await asked(ros, "getTopicType", "/A/cmd_vel"), "geometry_msgs/Twist");
  assert.deepEqual(await asked(ros, "getTopicsForType", "geometry_msgs/Twist"),
                   ["/A/cmd_vel", "/B/cmd_vel", "/C/cmd_vel"]);
  assert.equal((await asked(ros, "getMessageDetails", "rovernet_msgs/Received"))[0].fieldnames[0], "stamp");
  assert.deepEqual(await asked(topic(ros, "/A/odom", ""), "getPublishers"), ["/rovernet"]);
  assert.equal(await asked(new Param({ros, name: "/use_sim_time"}), "get"), true);
}

async function drives(ros) {
  const seen = {};
  for (const name of ["/A/odom", "A/odom"]) {
    topic(ros, name, "nav_msgs/Odometry").subscribe((message) => { seen[name] = message; });
  }
  topic(ros, "/tf", "tf2_msgs/TFMessage").subscribe(({transforms}) => { seen.tf = transforms[0]; });
  const command = topic(ros, "/A/cmd_vel", "geometry_msgs/Twist");
  const pose = () => seen["/A/odom"].pose.pose;
  const heading = () => 2 * Math.atan2(pose().orientation.z, pose().orientation.w);
  const begin = (await step(ros, 0.05)).time;
  command.publish(twist(0.5, 0));
  const middle = (await step(ros, 2)).time;
  near(time(seen["/A/odom"].header.stamp), time(middle), 0.05, "stamp");
  const straight = time(seen["/A/odom"].header.stamp) - time(begin);
  near(pose().position.x, 24 + 0.5 * straight, exact, "x after a straight way");
  near(pose().position.y, 12, exact, "y after a straight way");
  const x = 24 + 0.5 * (time(middle) - time(begin));
  command.publish(twist(0.4, 0.8));
  await step(ros, 1);
  const turned = 0.8 * (time(seen["/A/odom"].header.stamp) - time(middle));
  near(heading(), turned, exact, "heading on an arc");
  near(pose().position.x, x + 0.5 * Math.sin(turned), chord, "x on an arc");
  near(pose().position.y, 12 + 0.5 * (1 - Math.cos(turned)), chord, "y on an arc");
  assert.deepEqual(seen["A/odom"], seen["/A/odom"]);
  assert.equal(seen.tf.child_frame_id, "A/base_link");
  assert.deepEqual(seen.tf.transform.translation, pose().position);
  assert.deepEqual(seen.tf.transform.rotation, pose().orientation);
  command.publish(twist(0, 0));
}

async function throttles(ros) {
  const clock = topic(ros, "/clock", "rosgraph_msgs/Clock", {throttle_rate: 100, queue_length: 1});
  const clocks = await messages(clock, () => step(ros, 2));
  assert.equal(clocks.length, 20);
  for (let i = 1; i < clocks.length; ++i) {
    near(time(clocks[i].clock) - time(clocks[i - 1].clock), 0.1, exact, "time between two messages");
  }
}

async function refusesWhatIsWrong(ros, url) {
  const raw = new WebSocket(url);
  await once(raw, "open");
  const wrong = ["no JSON", "{", '{"op":"fly"}', '{"op":"subscribe","topic":"/A/odom","type":"std_msgs/String"}',
                 '{"op":"subscribe","topic":"/A/odom","compression":"cbor-raw"}',
                 '{"op":"publish","topic":"/A/cmd_vel","msg":{"linear":{"x":"fast"}}}'];
  for (const text of wrong) {
    raw.send(text);
    const status = JSON.parse((await once(raw, "message"))[0]);
    assert.equal(status.op, "status", text);
    assert.equal(status.level, "error", text);
  }
  raw.send('{"op":"call_service","id":"1","service":"rosapi/nodes"}');
  assert.equal(JSON.parse((await once(raw, "message"))[0]).result, true);
  raw.terminate();

  await assert.rejects(call(ros, "/nowhere"), /there is no service \/nowhere/);
  const refused = [];
  ros.on("status", ({msg}) => refused.push(msg));
  await new Service({ros, name: "/mine", serviceType: "example_interfaces/AddTwoInts"}).advertise(() => true);
  ros.callOnConnection({op: "advertise_action", type: "example_interfaces/Fibonacci", action: "/fib"});
  ros.authenticate("mac", "1.2.3.4", "5.6.7.8", "rand", 123, "admin", 456);
  await asked(ros, "getNodes");  // answers come in order
  for (const what of ["advertise_service", "advertise_action", "auth"]) {
    assert.ok(refused.some((text) => text.includes(`${what} is refused`)), what);
  }
}

async function speaksByRadio(ros, link) {
  const heard = {B: [], C: []};
  for (const name of ["B", "C"]) {
    topic(ros, `/${name}/radio/received`, "rovernet_msgs/Received")
      .subscribe((message) => heard[name].push(message));
  }
  const sent = await call(ros, "/A/radio/send", {dst_address: "*", dst_port: 7, data: btoa("help")});
  assert.equal(sent.accepted, true);
  await step(ros, 1);
  assert.equal(heard.B.length, 1);
  assert.equal(atob(heard.B[0].data), "help");
  assert.equal(heard.B[0].src_address, "A");
  assert.equal(heard.B[0].dst_port, 7);
  near(heard.B[0].rssi, link("B").rx_power_dbm, exact, "level at B");
  assert.equal(link("C").up, false);
  assert.deepEqual(heard.C, []);
}

async function packs(ros) {
  const scan = (name, compression) => topic(ros, name, "sensor_msgs/LaserScan", {compression});
  const found = Promise.all([next(scan("/A/scan", "none")), next(scan("A/scan", "cbor"))]);
  await step(ros, 0.1);
  const [json, cbor] = await found;
  assert.ok(cbor.ranges instanceof Float32Array);
  assert.deepEqual(Array.from(cbor.ranges, (each) => Number.isFinite(each) ? each : null),
                   json.ranges.map((each) => each === null ? null : Math.fround(each)));
  assert.equal(cbor.angle_min, json.angle_min);
  const map = await next(topic(ros, "/map", "nav_msgs/OccupancyGrid"));
  assert.equal(map.data.length, map.info.width * map.info.height);
}

async function stopsRobotsOfTheDead(ros, url) {
  const speed = async () => {
    const odometry = topic(ros, "/B/odom", "nav_msgs/Odometry");
    return (await messages(odometry, () => step(ros, 0.1))).at(-1).twist.twist.linear.x;
  };
  for (let i = 0; i < 3; ++i) {
    const client = spawn(process.execPath, [fileURLToPath(import.meta.url), "drive", url],
                         {stdio: ["ignore", "pipe", "inherit"]});
    await once(client.stdout, "data");
    near(await speed(), 0.1, exact, "speed of B");
    client.kill("SIGKILL");
    await once(client, "exit");
    let tries = 0;
    while (await speed() !== 0) assert.ok(++tries < 100, "B drives on without its client");
  }
}

async function drive(url) {
  const ros = await connected(url);
  topic(ros, "/B/cmd_vel", "geometry_msgs/Twist").publish(twist(0.1, 0));
  await asked(ros, "getNodes");
  console.log("driving");
}

async function check(command, scenario, folder) {
  const server = spawn(command, ["live", scenario, "--rosbridge", "127.0.0.1:0", "--speed", "10", "--out", folder],
                       {stdio: ["ignore", "pipe", "inherit"]});
  const lines = createInterface({input: server.stdout});
  const url = "ws://" + (await once(lines, "line"))[0].match(/^listening on (\S+) \(rosbridge\)$/)[1];
  const link = (to) => JSON.parse(execFileSync(command, ["link", scenario, "A", to, "--json"]));
  try {
    const ros = await connected(url);
    await call(ros, "/simulation/pause");
    const claims = {
      "a client asks what there is": () => asksWhatThereIs(ros),
      "messages of the radio have the level of `rovernet link`": () => speaksByRadio(ros, link),
      "scans in CBOR are those in JSON, and a map has all its cells": () => packs(ros),
      "cmd_vel drives on the arc that odometry and transforms tell": () => drives(ros),
      "a throttled topic has 10 messages in a simulated second": () => throttles(ros),
      "what is wrong is refused, and the connection goes on": () => refusesWhatIsWrong(ros, url),
      "the robot of a client that was killed stops": () => stopsRobotsOfTheDead(ros, url),
    };
    for (const [claim, hold] of Object.entries(claims)) {
      await hold();
      console.log(claim);
    }
    server.kill("SIGTERM");
    await Promise.all([once(ros, "close"), once(server, "exit")]);
    assert.equal(server.exitCode, 0);
  } finally {
    server.kill("SIGKILL");
  }
  console.log(execFileSync(command, ["replay", folder, "--verify"], {encoding: "utf8"}).split(":")[0]);
}

const [first, ...more] = process.argv.slice(2);
await (first === "drive" ? drive(...more) : check(first, ...more));
