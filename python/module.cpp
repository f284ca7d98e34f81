// SPDX-License-Identifier: MIT
// The module rovernet._core: what Python sees of the library. rovernet/_core.pyi says the same with
// types; python/rovernet/ has what is written in Python.
#include "experiment/version.hpp"
#include "python/run_object.hpp"
#include "python/scan_functions.hpp"
#include "python/session_functions.hpp"
#include "python/session_object.hpp"
#include "traces/fingerprint.hpp"

namespace rovernet::python {
namespace {

// Errors.

PyObject* input_error = nullptr;  // the type, which lives as long as the interpreter

void raise(const InputError& error) {
    const Location& where = error.where();
    const auto number = [](int n) -> py::object {
        return n > 0 ? py::object(py::int_(n)) : py::none();
    };
    const py::object raised = py::handle(input_error)(error.what());
    raised.attr("message") = error.message();
    raised.attr("file") = where.source;
    raised.attr("line") = number(where.line);
    raised.attr("column") = number(where.column);
    PyErr_SetObject(input_error, raised.ptr());
}

void add_errors(py::module_& m) {
    input_error = PyErr_NewExceptionWithDoc(
        "rovernet.InputError",
        "Mistake in a scenario or another input. str() is the message that the command prints.\n\n"
        "file: file, or the place in a dict; line, column: from 1, None for the whole file;\n"
        "message: what was found and what was expected, with a suggestion.",
        PyExc_ValueError, nullptr);
    if (!input_error) throw py::error_already_set();
    m.attr("InputError") = py::handle(input_error);
    py::register_exception<RunError>(m, "RunError", PyExc_RuntimeError).attr("__module__") =
        "rovernet";
    py::register_exception_translator([](std::exception_ptr thrown) {
        try {
            if (thrown) std::rethrow_exception(thrown);
        } catch (const InputError& error) {
            raise(error);
        }
    });
}

// Run.

void add_run(py::module_& m) {
    py::class_<RunObject>(m, "Run", "Result of a run.")
        .def_property_readonly("metrics", &RunObject::metrics,
                               "dict of the metrics, as in summary.json; times in seconds.")
        .def_property_readonly(
            "timeline", &RunObject::timeline,
            "list of the events of the timeline: dicts with t_ns, robot and text.")
        .def_property_readonly("names", &RunObject::names,
                               "Names of all robots, in the order of their numbers.")
        .def_property_readonly(
            "fingerprint", [](const RunObject& run) { return run.result().fingerprint; },
            "16 hexadecimal digits that are the same for identical runs, on every machine.")
        .def_property_readonly(
            "folder",
            [](const RunObject& run) {
                const std::string& folder = run.result().folder;
                return folder.empty() ? std::nullopt : std::optional(folder);
            },
            "Folder of the results; None if they were not written.")
        .def_property_readonly(
            "seed", [](const RunObject& run) { return run.scenario().scenario.seed; },
            "Seed of the random draws.")
        .def_property_readonly(
            "duration", [](const RunObject& run) { return seconds(run.result().simulated); },
            "Simulated time [s].")
        .def(
            "records", &RunObject::records, "kind"_a,
            "Structured array of all records of a kind, such as \"received\". Times are in ns,\n"
            "robots are numbers, -1 is everyone or nobody. If records= did not keep the kind, the\n"
            "scenario is run once more, which gives the same records.")
        .def("__repr__", [](const RunObject& run) {
            return fmt::format("<rovernet.Run of {} s, fingerprint {}>",
                               seconds(run.result().simulated), run.result().fingerprint);
        });
    m.def(
        "run", &run, "scenario"_a, py::kw_only(), "set"_a = py::none(), "seed"_a = py::none(),
        "out"_a = py::none(), "records"_a = std::vector<std::string>(), "progress"_a = py::none(),
        "Runs a scenario to its end.\n\n"
        "scenario: path of a scenario, a Stage world or a movement file; or a dict with the same\n"
        "          tables, in which a number without a unit is in SI units\n"
        "set:      dict of keys to change: {\"propagation.model\": \"friis\"}\n"
        "seed:     seed of the random draws; None: the scenario's seed\n"
        "out:      folder for the results, as `rovernet run` writes them; None: no files\n"
        "records:  kinds of records to keep for Run.records()\n"
        "progress: function that is called repeatedly with the finished share, 0 ... 1\n\n"
        "Raises InputError for a mistake in the scenario, RunError if the scenario cannot be run.");
}

// Session.

void add_heard(py::module_& m) {
    const auto name = [](NodeId HeardMessage::*robot) {
        return [robot](const HeardObject& heard) { return heard.name(heard.message.*robot); };
    };
    const auto t_ns = [](const HeardObject& heard) {
        return std::int64_t{heard.message.time.time_since_epoch().count()};
    };
    const auto rssi = [](const HeardObject& heard) {
        return heard.message.level ? std::optional(heard.message.level->value) : std::nullopt;
    };
    py::class_<HeardObject>(m, "Heard", "Message that a robot heard.")
        .def_property_readonly("at", name(&HeardMessage::at), "Robot that heard the message.")
        .def_property_readonly("t_ns", t_ns, "Time [ns] since the start.")
        .def_property_readonly("origin", name(&HeardMessage::from),
                               "Robot that sent the message first.")
        .def_property_readonly("last_hop", name(&HeardMessage::last_hop),
                               "Robot that sent the frame in which the message arrived.")
        .def_property_readonly(
            "hops", [](const HeardObject& heard) { return heard.message.hops; },
            "Number of hops that the message crossed.")
        .def_property_readonly(
            "port", [](const HeardObject& heard) { return heard.message.port; },
            "Port to which the message was sent.")
        .def_property_readonly(
            "rssi", rssi,
            "Received level [dBm] of the frame in which the message arrived; None: not known.")
        .def_property_readonly(
            "noise", [](const HeardObject& heard) { return heard.noise; },
            "Noise at the robot [dBm].")
        .def_property_readonly(
            "data", [](const HeardObject& heard) { return py::bytes(heard.message.payload); },
            "Content.")
        .def("__eq__", &HeardObject::operator==, py::is_operator())
        .def("__repr__", [=](const HeardObject& heard) {
            return py::str("<Heard at {} at {} s from {} by {}, {} hops: {!r}>")
                .format(heard.name(heard.message.at), seconds(heard.message.time),
                        heard.name(heard.message.from), heard.name(heard.message.last_hop),
                        heard.message.hops, py::bytes(heard.message.payload));
        });
}

// Callbacks of a session may refer to it: the collector of garbage is told.

SessionObject* session_in(PyObject* self) {
    auto* instance = reinterpret_cast<py::detail::instance*>(self);
    const auto holder = instance->get_value_and_holder();
    return holder.holder_constructed() ? holder.value_ptr<SessionObject>() : nullptr;
}
int traverse(PyObject* self, visitproc visit, void* arg) {
    Py_VISIT(Py_TYPE(self));
    int result = 0;
    if (const SessionObject* session = session_in(self)) {
        session->for_each_callback([&](const py::object& function) {
            if (result == 0) result = visit(function.ptr(), arg);
        });
    }
    return result;
}
int clear(PyObject* self) {
    if (SessionObject* session = session_in(self)) session->forget_callbacks();
    return 0;
}

using SessionClass = py::class_<SessionObject>;

SessionClass session_class(py::module_& m) {
    return SessionClass(
        m, "Session",
        "Scenario whose robots a program drives, step by step.\n\n"
        "scenario, set, seed: see run()\n"
        "step:    simulated time of a step [s], 1 us or more\n"
        "robots:  names of the robots that the program drives, in the order of the rows of all\n"
        "         arrays; None: all. Other robots move as in the scenario\n"
        "out:     folder to which finish() writes results and the log of inputs; None: no files\n"
        "records: kinds of records to keep for records()\n\n"
        "At its end, a with-statement calls finish().",
        py::custom_type_setup([](PyHeapTypeObject* type) {
            type->ht_type.tp_flags |= Py_TPFLAGS_HAVE_GC;
            type->ht_type.tp_traverse = traverse;
            type->ht_type.tp_clear = clear;
        }));
}

void add_run(SessionClass& session) {
    session
        .def(py::init<const py::object&, const StepArgument&, const py::object&, const py::object&,
                      const RobotsArgument&, const py::object&, const KindsArgument&>(),
             "scenario"_a, py::kw_only(), "step"_a = 0.1, "seed"_a = py::none(),
             "set"_a = py::none(), "robots"_a = py::none(), "out"_a = py::none(),
             "records"_a = std::vector<std::string>())
        .def("step", &SessionObject::step,
             "Runs for a step, or to the scenario's end. Returns the messages that the robots\n"
             "heard, in order of time. Raises RunError if the run is at its end.")
        .def("reset", &SessionObject::reset, "seed"_a = py::none(),
             "Begins the run anew. seed: None: the same seed again.")
        .def("finish", &SessionObject::finish,
             "Stops the robots, ends the run at the current time, and writes the results if out=\n"
             "names a folder. Returns the Run.")
        .def("on_record", &SessionObject::on_record, "kind"_a, "function"_a,
             "Calls function(dict) for each record of a kind, during steps; None: ends the calls.\n"
             "Commands that the function gives take effect in the next step. An error in it\n"
             "ends the step.")
        .def("records", &SessionObject::records, "kind"_a,
             "Structured array of the records so far; the kind must be one of records=.")
        .def("__enter__", [](const py::object& self) { return self; })
        .def("__exit__", [](SessionObject& self, const py::object& error, const py::object&,
                            const py::object&) {
            if (error.is_none() && !self.run().is_over()) self.finish();
        });
}

void add_commands(SessionClass& session) {
    const auto stop = [](SessionObject& self, const RobotArgument& robot) {
        self.run().command(self.row(robot.value), StopCommand{});
    };
    session
        .def("drive", &drive, "vw"_a, "timeout"_a = py::none(),
             "Drives robots from the next step on, until they get another command.\n\n"
             "vw: (n, 2), speed ahead [m/s] and turn rate [rad/s], counter-clockwise; a row of\n"
             "    nan does not change the command of its robot\n"
             "timeout: the robots stop after this time [s]; None: never")
        .def("go_to", &go_to, "robot"_a, "to"_a, "speed"_a = 1.0,
             "Sends a robot to a place (x, y) or (x, y, z) [m], around the walls, at a speed "
             "[m/s].\nWithout z the robot stays at its height.")
        .def("place", &place, "robot"_a, "x"_a, "y"_a, "heading"_a = py::none(), "z"_a = py::none(),
             "Moves a robot to (x, y, z) [m] with a heading [rad] when the next step begins;\n"
             "there it stands still. None: the current height or heading.")
        .def("stop", stop, "robot"_a, "Stops a robot.")
        .def("command", &command, "robot"_a,
             "Gives a robot any command. The keywords are keys of the lock-step protocol, such "
             "as\nv=0.5, w=0.1. Times are in seconds, data are bytes.")
        .def("send", &send, "robot"_a, "data"_a, "to"_a = py::none(), "port"_a = 0,
             "size"_a = py::none(),
             "Lets a robot send bytes when the next step begins.\n\n"
             "to:   None: everyone, by the routing protocol; a robot: over one hop\n"
             "port: number that distinguishes the programs of the receiver\n"
             "size: size on air [bytes]; None: the size of the data");
}

/// What a session knows of its robots.
void add_robots(SessionClass& session) {
    const auto on = [](SessionObject& self) {
        return by_robot<bool>(self, [](Session& s, NodeId robot) {
            return s.network().medium().stations().is_on(robot);
        });
    };
    const auto z = [](SessionObject& self) {
        return by_robot<double>(
            self, [](Session& s, NodeId robot) { return s.network().position(robot).z; });
    };
    const auto stalled = [](SessionObject& self) {
        return by_robot<bool>(self, [](Session& s, NodeId robot) { return s.is_stalled(robot); });
    };
    const auto no_way = [](SessionObject& self) {
        return by_robot<bool>(self, [](Session& s, NodeId robot) { return s.has_no_way(robot); });
    };
    session
        .def_property_readonly(
            "robots", &robots,
            "Names of the robots that the program drives, in the order of the rows of all arrays.")
        .def_property_readonly(
            "names", [](SessionObject& self) { return self.names(); },
            "Names of all robots, in the order of their numbers.")
        .def_property_readonly(
            "pose", &pose,
            "(n, 3): x [m], y [m], heading [rad]. A view of an array that each step updates.")
        .def_property_readonly("z", z, "(n,): height [m].")
        .def_property_readonly("twist", &twist, "(n, 2): speed [m/s], turn rate [rad/s].")
        .def_property_readonly("on", on, "(n,): whether the radio is on.")
        .def_property_readonly("stalled", stalled,
                               "(n,): whether the robot has a command to drive, but cannot move.")
        .def_property_readonly(
            "no_way", no_way,
            "(n,): whether the robot has a command to go to a place, but no path leads there.")
        .def("scan", &scan, "robot"_a = py::none(), "scanner"_a = 0,
             "Distances that a range finder measures now [m]: (beams,) of one robot; None:\n"
             "(n, beams) of all driven robots, if all have the same number of beams.\n\n"
             "scanner: number or name of the range finder")
        .def("scanners", &scanners, "robot"_a,
             "Range finders of a robot, as dicts: name, kind, range [m], and for each beam its\n"
             "angle from the robot's heading [rad] and its begin (x ahead, y to the left) [m].")
        .def("links", &links,
             "(N, N), all robots by number: level [dBm] at which the robot of the row now "
             "hears\nthe robot of the column; nan: it does not hear that robot.")
        .def("neighbors", &neighbors, "robot"_a,
             "Structured array of the robots that a robot's radio hears now: name, rssi [dBm],\n"
             "noise [dBm], quality from 0 to 100.");
}

/// What a session knows of its run.
void add_state(SessionClass& session) {
    const auto t_ns = [](SessionObject& self) {
        return std::int64_t{self.network().now().time_since_epoch().count()};
    };
    session.def_property_readonly("t_ns", t_ns, "Simulated time [ns].")
        .def_property_readonly(
            "time", [](SessionObject& self) { return seconds(self.network().now()); },
            "Simulated time [s].")
        .def_property_readonly(
            "end", [](SessionObject& self) { return seconds(self.run().session().end()); },
            "Time at which the scenario ends [s].")
        .def_property_readonly(
            "done", [](SessionObject& self) { return self.run().is_done(); },
            "Whether the scenario is at its end.")
        .def_property_readonly(
            "seed", [](SessionObject& self) { return self.run().scenario().scenario.seed; },
            "Seed of the random draws.")
        .def_property_readonly("metrics", &metrics, "dict of the metrics so far.")
        .def_property_readonly(
            "fingerprint", [](SessionObject& self) { return self.run().fingerprint(); },
            "16 hexadecimal digits that are the same for runs that are identical so far.");
}

}  // namespace

PYBIND11_MODULE(_core, m) {
    m.doc() = "The simulator itself; import rovernet instead.";
    m.attr("__version__") = std::string(version());
    add_errors(m);
    add_heard(m);
    add_run(m);
    SessionClass session = session_class(m);
    add_run(session);
    add_commands(session);
    add_robots(session);
    add_state(session);
}

}  // namespace rovernet::python
