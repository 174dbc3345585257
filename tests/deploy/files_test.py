#!/usr/bin/env python3
"""What deploy/ says against what the binary says: files_test.py PATH_OF_FROXEL.

Manifests are those that `kubectl kustomize` renders, where there is a kubectl, held against the types of
Kubernetes' API; what only a cluster knows is not tested.
"""

import contextlib
import copy
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
import tomllib
import unittest
import urllib.request
from pathlib import Path

import yaml

import manifest_types

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
import told_skips

FROXEL = sys.argv.pop(1) if len(sys.argv) > 1 else "froxel"
ROOT = Path(__file__).resolve().parents[2]
DEPLOY = ROOT / "deploy"


def run(*command):
    return subprocess.run([*map(str, command)], check=True, capture_output=True, text=True).stdout


def run_code(*command):
    return subprocess.run([*map(str, command)], check=False, capture_output=True).returncode


def seconds(text):
    """Of "30s", "1h" or a number, as proxies, systemd and compose write it."""
    number, unit = re.fullmatch(r"(\d+)(s|m|h|)", str(text)).groups()
    return int(number) * {"": 1, "s": 1, "m": 60, "h": 3600}[unit]


def mebibytes(text):
    """Of "3Gi", as Kubernetes writes it, or "3g", as compose does."""
    number, unit = re.fullmatch(r"(\d+)([GgMm])i?", text).groups()
    return int(number) * {"g": 1024, "m": 1}[unit.lower()]


def defaulted(text):
    """What compose makes of "${NAME:-value}" where NAME is not set."""
    return re.sub(r"\$\{\w+:-([^}]*)\}", r"\1", str(text))


# https://kubernetes.io/docs/concepts/security/pod-security-standards/
ALLOWED_VOLUMES = {"configMap", "csi", "downwardAPI", "emptyDir", "ephemeral", "persistentVolumeClaim", "projected",
                   "secret"}


def restricted_faults(pod):
    """What the level restricted of the Pod Security Standards, which has baseline in it, forbids in a pod."""
    of_pod = pod.get("securityContext", {})
    faults = [name for name in ("hostNetwork", "hostPID", "hostIPC") if pod.get(name)]
    faults += [f"volume of {kind}" for volume in pod.get("volumes", []) for kind in volume
               if kind != "name" and kind not in ALLOWED_VOLUMES]
    if not of_pod.get("runAsNonRoot"):
        faults.append("runAsNonRoot of the pod")
    if of_pod.get("seccompProfile", {}).get("type") not in ("RuntimeDefault", "Localhost"):
        faults.append("seccompProfile of the pod")
    faults += [name for name in ("sysctls", "windowsOptions") if of_pod.get(name)]
    for container in [*pod.get("initContainers", []), *pod["containers"]]:
        context = {"runAsUser": of_pod.get("runAsUser"), **container.get("securityContext", {})}
        wrong = {
            "privileged": context.get("privileged", False),
            "allowPrivilegeEscalation": context.get("allowPrivilegeEscalation") is not False,
            "capabilities": context.get("capabilities", {}).get("drop") != ["ALL"]
                            or set(context["capabilities"].get("add", [])) - {"NET_BIND_SERVICE"},
            "runAsUser": context["runAsUser"] == 0,
            "runAsNonRoot": context.get("runAsNonRoot", True) is False,
            "procMount": context.get("procMount", "Default") != "Default",
            "hostPort": any("hostPort" in port for port in container.get("ports", [])),
        }
        faults += [f"{name} of {container['name']}" for name, fault in wrong.items() if fault]
    return faults


# What a CPU server takes beside its sessions: the built-in scene on the device; and the process with
# the scene on the host, compiled pipelines and encoders' scratch. MiB, see Sizing in deploy/README.md.
SCENE_MIB = 128
PROCESS_MIB = 512


@contextlib.contextmanager
def fresh_server():
    """A server that nobody has come to yet, as the text of its /metrics."""
    with subprocess.Popen([FROXEL, "serve", "--device", "cpu", "--port", "0", "--admin-bind",
                           "127.0.0.1:0"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                          text=True) as server:
        try:
            server.stdout.readline()
            admin = server.stdout.readline().strip()
            deadline = time.monotonic() + 60
            while run_code(FROXEL, "probe", admin.replace("/metrics", "/startupz")) != 0:
                if time.monotonic() > deadline:
                    raise TimeoutError("the server does not start")
                time.sleep(0.1)
            yield urllib.request.urlopen(admin, timeout=20).read().decode()
        finally:
            server.terminate()


class Files(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.service = json.loads(run(FROXEL, "info", "--json", "--device", "cpu"))["service"]
        cls.options = set(re.findall(r"--([a-z][a-z-]+)", run(FROXEL, "serve", "--help")))
        cls.variables = {"FROXEL_" + name.upper().replace("-", "_") for name in cls.options}

    def assert_variables(self, names):
        self.assertLessEqual({name for name in names if name.startswith("FROXEL_")}, self.variables)

    def manifests(self, folder):
        if not shutil.which("kubectl"):
            self.skipTest("kubectl is not here")
        if "kustomizeVersion" not in run("kubectl", "version", "--client", "--output", "json"):
            self.skipTest("this kubectl is older than 1.24 (Debian 12's) and knows no labels")
        done = subprocess.run(["kubectl", "kustomize", DEPLOY / "kubernetes" / folder],
                              check=True, capture_output=True, text=True)
        self.assertEqual(done.stderr, "", "kustomize warns of what it will drop")
        return list(yaml.safe_load_all(done.stdout))

    def composed(self, *components):
        """The manifests of overlays/cpu with these components."""
        with tempfile.TemporaryDirectory() as folder:
            there = os.path.relpath(DEPLOY / "kubernetes", Path(folder).resolve())
            kustomization = {"apiVersion": "kustomize.config.k8s.io/v1beta1", "kind": "Kustomization",
                             "resources": [f"{there}/overlays/cpu"],
                             "components": [f"{there}/components/{name}" for name in components]}
            (Path(folder) / "kustomization.yaml").write_text(yaml.safe_dump(kustomization))
            return self.manifests(folder)

    def kinds_of(self, folder):
        kinds = {}
        for document in self.manifests(folder):
            kinds.setdefault(document["kind"], []).append(document)
        return kinds

    def test_overlays_agree_with_the_binary_and_with_themselves(self):
        for overlay in ("cpu", "nvidia", "example"):
            with self.subTest(overlay):
                kinds = self.kinds_of("overlays/" + overlay)
                self.check_manifests(kinds)
                if overlay == "example":
                    self.check_components(kinds)

    def test_overlays_of_devices_need_nothing_but_kubernetes(self):
        self.require_types()
        for overlay in ("cpu", "nvidia"):
            for document in self.manifests("overlays/" + overlay):
                self.assertTrue(str(manifest_types.module_of(document["apiVersion"])).startswith("kubernetes-types"),
                                document["kind"])
                self.assertNotIn(document["kind"], ("Ingress", "HorizontalPodAutoscaler"))

    def test_everything_is_in_the_namespace(self):
        for documents in (self.manifests("overlays/example"), self.composed("scenes-volume", "uploads")):
            for document in documents:
                if document["kind"] != "Namespace":
                    self.assertEqual(document["metadata"]["namespace"], "froxel", document["metadata"]["name"])

    def test_uploads_fit_their_volume(self):
        pod, = [document["spec"]["template"]["spec"] for document in self.composed("uploads")
                if document["kind"] == "Deployment"]
        options = {entry["name"]: entry.get("value") for entry in pod["containers"][0]["env"]}
        folder = options["FROXEL_UPLOAD_FOLDER"]
        mount, = [mount["name"] for mount in pod["containers"][0]["volumeMounts"] if mount["mountPath"] == folder]
        volume, = [volume for volume in pod["volumes"] if volume["name"] == mount]
        self.assertLess(int(options["FROXEL_UPLOAD_SPACE"]), 1024 * int(volume["emptyDir"]["sizeLimit"].removesuffix("Gi")))

    def test_pods_are_restricted_as_their_namespace_demands(self):
        """Kubernetes' Pod Security Standards, level restricted, which admission would enforce."""
        pods = [(document["kind"], document["spec"]["template"]["spec"])
                for documents in (self.manifests("overlays/nvidia"), self.manifests("overlays/example"),
                                  self.composed("scenes-volume", "uploads"))
                for document in documents if document["kind"] == "Deployment"]
        self.assertEqual(len(pods), 3)
        for name, pod in pods:
            self.assertEqual(restricted_faults(pod), [], name)
        fleet, = self.kinds_of("agones")["Fleet"]
        pod = fleet["spec"]["template"]["spec"]["template"]["spec"]
        self.assertEqual(restricted_faults(pod), [])

    def test_what_restricted_forbids_is_found(self):
        (_, pod), = [("", document["spec"]["template"]["spec"]) for document in self.manifests("overlays/example")
                     if document["kind"] == "Deployment"]
        changes = {
            "hostNetwork": lambda pod: pod.update(hostNetwork=True),
            "hostPath": lambda pod: pod["volumes"].append({"name": "a", "hostPath": {"path": "/"}}),
            "runAsNonRoot": lambda pod: pod["securityContext"].update(runAsNonRoot=False),
            "runAsUser": lambda pod: pod["containers"][0]["securityContext"].update(runAsUser=0),
            "seccompProfile": lambda pod: pod["securityContext"].pop("seccompProfile"),
            "allowPrivilegeEscalation":
                lambda pod: pod["initContainers"][0]["securityContext"].pop("allowPrivilegeEscalation"),
            "privileged": lambda pod: pod["containers"][0]["securityContext"].update(privileged=True),
            "capabilities": lambda pod: pod["initContainers"][0]["securityContext"].pop("capabilities"),
            "hostPort": lambda pod: pod["containers"][0]["ports"][0].update(hostPort=80),
        }
        for words, change in changes.items():
            broken = copy.deepcopy(pod)
            change(broken)
            faults = restricted_faults(broken)
            self.assertEqual(len(faults), 1, (words, faults))
            self.assertIn(words, faults[0])

    def check_components(self, kinds):
        """What the example adds."""
        service = self.service
        deployment, = kinds["Deployment"]
        pod = deployment["spec"]["template"]["spec"]
        self.assertEqual(kinds["ServiceMonitor"][0]["spec"]["endpoints"][0]["path"],
                         service["metrics_path"])
        monitored = kinds["ServiceMonitor"][0]["spec"]["selector"]["matchLabels"].items()
        admin, = [entry for entry in kinds["Service"]
                  if monitored <= entry["metadata"].get("labels", {}).items()]
        self.assertEqual(admin["spec"]["ports"][0]["port"], service["admin_port"])
        self.assertEqual(kinds["HorizontalPodAutoscaler"][0]["spec"]["scaleTargetRef"]["name"],
                         deployment["metadata"]["name"])
        paths = {}
        for ingress in kinds["Ingress"]:
            annotations = ingress["metadata"]["annotations"]
            self.assertGreater(int(annotations["nginx.ingress.kubernetes.io/proxy-read-timeout"]),
                               service["idle_timeout_seconds"])
            self.assertIn("cert-manager.io/cluster-issuer", annotations)
            self.assertIn("nginx.ingress.kubernetes.io/auth-url", annotations)
            rule, = ingress["spec"]["rules"]
            self.assertEqual([rule["host"]], ingress["spec"]["tls"][0]["hosts"])
            self.assertNotEqual(rule["host"], "froxel.example.org", "the overlay names its own")
            path, = rule["http"]["paths"]
            paths[path["path"]] = annotations
            backend = path["backend"]["service"]
            public, = [entry for entry in kinds["Service"]
                       if entry["metadata"]["name"] == backend["name"]]
            self.assertEqual(public["spec"]["ports"][0]["name"], backend["port"]["name"])
        self.assertEqual(set(paths), {"/", service["room_socket_path"]})
        rooms = paths[service["room_socket_path"]]
        self.assertEqual(rooms["nginx.ingress.kubernetes.io/upstream-hash-by"], "$arg_room")
        self.assertNotIn("nginx.ingress.kubernetes.io/affinity", rooms, "a cookie would count before the hash")
        copies, = pod["initContainers"]
        config = [entry["configMapRef"]["name"] for entry in copies["envFrom"] if "configMapRef" in entry]
        self.assertLessEqual(set(config), {entry["metadata"]["name"] for entry in kinds["ConfigMap"]})
        mounts = [mount for mount in pod["containers"][0]["volumeMounts"] if mount["name"] == "scenes"]
        self.assertEqual(mounts, [{"name": "scenes", "mountPath": self.image_variable("FROXEL_SCENES"),
                                   "readOnly": True}])
        ports = [port["port"] for rule in kinds["NetworkPolicy"][0]["spec"]["egress"] for port in rule["ports"]]
        self.assertIn(443, ports)

    @staticmethod
    def image_variable(name):
        return re.search(rf"^\s+{name}=(\S+)", (DEPLOY / "Dockerfile").read_text(), re.M)[1]

    def require_types(self):
        if not manifest_types.available():
            self.skipTest("npm's typescript and kubernetes-types are not in client-web/node_modules")

    def test_manifests_are_of_the_types_of_the_api(self):
        self.require_types()
        documents = [document for name in ("cpu", "nvidia", "example")
                     for document in self.manifests(f"overlays/{name}")]
        documents += self.composed("scenes-volume")
        for block in re.findall("```yaml\n(.*?)```", (DEPLOY / "README.md").read_text(), re.S):
            documents += [entry for entry in [yaml.safe_load(block)] if "apiVersion" in entry]
        self.assertIn("ScaledObject", {document["kind"] for document in documents})
        self.assertEqual(manifest_types.complaints(documents), [])

    def test_what_the_api_would_not_take_is_found(self):
        self.require_types()
        by_kind = {document["kind"]: document for document in self.manifests("overlays/example")}

        def broken(kind, path, value):
            """A copy with another value (None: without it) at the path, keys with dots between."""
            document = copy.deepcopy(by_kind[kind])
            *parents, last = [int(key) if key.isdigit() else key for key in path.split(".")]
            place = document
            for key in parents:
                place = place[key]
            place[last] = value
            if value is None:
                del place[last]
            return document

        pod = "spec.template.spec"
        cases = [
            ("replica", broken("Deployment", "spec.replica", 2)),
            ("livenesProbe", broken("Deployment", f"{pod}.containers.0.livenesProbe", {})),
            ("capability", broken("Deployment", f"{pod}.containers.0.securityContext.capability", {})),
            ("'string' is not assignable to type 'number'",
             broken("Deployment", "spec.replicas", "two")),
            ("'number' is not assignable to type 'string'",
             broken("Deployment", f"{pod}.containers.0.env.0.value", 1)),
            ("'boolean' is not assignable to type 'string'",
             broken("Ingress", "metadata.annotations.flag", True)),
            ("selector", broken("Deployment", "spec.selector", None)),
            ("maxReplicas", broken("HorizontalPodAutoscaler", "spec.maxReplicas", None)),
            ("endpoint", broken("ServiceMonitor", "spec.endpoint", [])),
            ("autoscaling/v3", broken("HorizontalPodAutoscaler", "apiVersion", "autoscaling/v3")),
            ("Deploymint", broken("Deployment", "kind", "Deploymint")),
        ]
        told = manifest_types.complaints([document for _, document in cases])
        self.assertEqual(sum(line.startswith(("manifests.ts", "document ")) for line in told), len(cases), told)
        for words, _ in cases:
            self.assertTrue(any(words in line for line in told), (words, told))

    def check_manifests(self, kinds):
        service = self.service
        deployment, = kinds["Deployment"]
        pod = deployment["spec"]["template"]["spec"]
        container, = pod["containers"]
        ports = {port["name"]: port["containerPort"] for port in container["ports"]}
        self.assertEqual(ports, {"http": service["port"], "admin": service["admin_port"]})
        for probe, path in (("startupProbe", "started_path"), ("readinessProbe", "ready_path"),
                            ("livenessProbe", "live_path")):
            self.assertEqual(container[probe]["httpGet"], {"path": service[path], "port": "admin"})

        config_map, = [entry for entry in kinds["ConfigMap"] if "froxel.toml" in entry["data"]]
        config = tomllib.loads(config_map["data"]["froxel.toml"])
        self.assertLessEqual(set(config), self.options)
        env = {entry["name"]: entry["value"] for entry in container["env"]}
        self.assert_variables(env)
        wait = int(container["lifecycle"]["preStop"]["exec"]["command"][1])
        self.assertGreater(pod["terminationGracePeriodSeconds"], wait + config["drain-seconds"])
        # Unready after one failure, and heard of before SIGTERM.
        self.assertGreater(wait, container["readinessProbe"]["periodSeconds"])

        self.check_pod(pod, config_map)
        self.assertEqual(deployment["spec"]["strategy"]["rollingUpdate"],
                         {"maxUnavailable": 0, "maxSurge": 1})
        labels = deployment["spec"]["template"]["metadata"]["labels"]
        selectors = [deployment["spec"]["selector"]["matchLabels"],
                     kinds["PodDisruptionBudget"][0]["spec"]["selector"]["matchLabels"],
                     kinds["NetworkPolicy"][0]["spec"]["podSelector"]["matchLabels"],
                     pod["topologySpreadConstraints"][0]["labelSelector"]["matchLabels"],
                     *(entry["spec"]["selector"] for entry in kinds["Service"])]
        for selector in selectors:
            self.assertLessEqual(selector.items(), labels.items())
        for entry in kinds["Service"]:
            for port in entry["spec"]["ports"]:
                self.assertIn(port["targetPort"], ports)
        for rule in kinds["NetworkPolicy"][0]["spec"]["ingress"]:
            self.assertIn(rule["ports"][0]["port"], ports)

    def assert_memory(self, what, limit, sessions, env):
        """Sessions, each at its limit, and the scene fit into the share of a CPU server's memory
        that they have."""
        if env.get("FROXEL_DEVICE") == "gpu":
            return  # most is the GPU's; the host's part has a limit of its own
        service = self.service
        session = int(env.get("FROXEL_SESSION_MEMORY", service["session_memory_mib"]["cpu"]))
        self.assertLessEqual(sessions * session + SCENE_MIB,
                             service["host_memory_share"] * mebibytes(limit), what)
        self.assertGreaterEqual((1 - service["host_memory_share"]) * mebibytes(limit), PROCESS_MIB, what)

    def test_memory_limits_hold_all_sessions(self):
        for folder in ("overlays/cpu", "overlays/nvidia", "agones"):
            kinds = self.kinds_of(folder)
            template = kinds["Deployment"][0]["spec"]["template"] if "Deployment" in kinds \
                else kinds["Fleet"][0]["spec"]["template"]["spec"]["template"]
            container, = template["spec"]["containers"]
            config = tomllib.loads(kinds["ConfigMap"][0]["data"]["froxel.toml"])
            env = {entry["name"]: entry["value"] for entry in container["env"]}
            sessions = int(env.get("FROXEL_MAX_SESSIONS", config["max-sessions"]))
            self.assert_memory(folder, container["resources"]["limits"]["memory"], sessions, env)
        froxel = yaml.safe_load((DEPLOY / "compose.yaml").read_text())["services"]["froxel"]
        env = {name: defaulted(value) for name, value in froxel["environment"].items()}
        self.assert_memory("compose", defaulted(froxel["mem_limit"]),
                           int(env["FROXEL_MAX_SESSIONS"]), env)

    def check_pod(self, pod, config_map):
        """What every pod of ours has: nothing that it could misuse, and its configuration."""
        container, = pod["containers"]
        self.assertTrue(pod["securityContext"]["runAsNonRoot"])
        self.assertEqual(pod["securityContext"]["seccompProfile"]["type"], "RuntimeDefault")
        self.assertEqual(container["securityContext"],
                         {"allowPrivilegeEscalation": False, "readOnlyRootFilesystem": True,
                          "capabilities": {"drop": ["ALL"]}})
        self.assertFalse(pod["enableServiceLinks"], "FROXEL_PORT would be a URL")
        mounts = {mount["name"] for mount in container["volumeMounts"]}
        self.assertEqual(mounts, {volume["name"] for volume in pod["volumes"]})
        volumes = {volume["name"]: volume for volume in pod["volumes"]}
        self.assertEqual(volumes["config"]["configMap"]["name"], config_map["metadata"]["name"])

    def test_fleet_agrees_with_the_binary_and_with_the_deployment(self):
        kinds = self.kinds_of("agones")
        fleet, = kinds["Fleet"]
        server = fleet["spec"]["template"]["spec"]
        pod = server["template"]["spec"]
        container, = pod["containers"]
        config_map, = kinds["ConfigMap"]
        self.check_pod(pod, config_map)
        config = tomllib.loads(config_map["data"]["froxel.toml"])
        self.assertLessEqual(set(config), self.options)
        self.assertTrue(config["agones"])
        env = {entry["name"]: entry["value"] for entry in container["env"]}
        self.assert_variables(env)
        self.assertGreater(pod["terminationGracePeriodSeconds"], config["drain-seconds"])

        port, = server["ports"]
        self.assertEqual((str(port["containerPort"]), port["protocol"]), (env["FROXEL_PORT"], "TCP"))
        self.assertNotEqual(port["containerPort"], 8080, "Agones' container listens there")
        self.assertEqual(container["ports"],
                         [{"name": "admin", "containerPort": self.service["admin_port"]}])
        # The rest as in the Deployment, but for liveness, which Agones asks its own container for.
        deployment, = self.kinds_of("overlays/cpu")["Deployment"]
        other = deployment["spec"]["template"]["spec"]["containers"][0]
        for name in ("startupProbe", "readinessProbe", "resources", "volumeMounts", "image", "args"):
            self.assertEqual(container[name], other[name], name)
        self.assertNotIn("livenessProbe", container)
        self.assertGreaterEqual(server["health"]["periodSeconds"],
                                2 * self.service["agones_health_seconds"])

        counter = self.service["agones_counter"]
        self.assertEqual(server["counters"],
                         {counter: {"count": 0, "capacity": config["max-sessions"]}})
        autoscaler, = kinds["FleetAutoscaler"]
        self.assertEqual(autoscaler["spec"]["fleetName"], fleet["metadata"]["name"])
        policy = autoscaler["spec"]["policy"]
        self.assertEqual((policy["type"], policy["counter"]["key"]), ("Counter", counter))
        allocation = yaml.safe_load((DEPLOY / "kubernetes/agones/allocation.yaml").read_text())
        for selector in allocation["spec"]["selectors"]:
            self.assertEqual(selector["matchLabels"], {"agones.dev/fleet": fleet["metadata"]["name"]})
            self.assertEqual(list(selector["counters"]), [counter])
        self.assertEqual(allocation["metadata"]["namespace"], fleet["metadata"]["namespace"])

        labels = server["template"]["metadata"]["labels"].items()
        policy, = kinds["NetworkPolicy"]
        self.assertLessEqual(policy["spec"]["podSelector"]["matchLabels"].items(), labels)
        self.assertEqual([rule["ports"][0]["port"] for rule in policy["spec"]["ingress"]],
                         [port["containerPort"], "admin"])
        monitor, = kinds["PodMonitor"]
        self.assertLessEqual(monitor["spec"]["selector"]["matchLabels"].items(), labels)
        self.assertEqual(monitor["spec"]["podMetricsEndpoints"][0]["path"],
                         self.service["metrics_path"])

    def test_image_agrees_with_the_binary(self):
        text = (DEPLOY / "Dockerfile").read_text()
        self.assert_variables(re.findall(r"FROXEL_[A-Z_]+", text))
        self.assertIn(f"EXPOSE {self.service['port']} {self.service['admin_port']}\n", text)
        self.assertIn(f"http://127.0.0.1:{self.service['admin_port']}{self.service['live_path']}",
                      text)
        self.assertIn("\nUSER 10001:10001\n", text)
        self.assertIn("\nSTOPSIGNAL SIGTERM\n", text)

    @unittest.skipUnless(shutil.which("dpkg-shlibdeps"), "no dpkg-shlibdeps")
    def test_image_has_the_libraries_that_the_binary_needs(self):
        linked = run("bash", "-c", f'. "{DEPLOY}/common.sh"; linked_packages "$0"', FROXEL).split()
        installed = run("dpkg-query", "--show", "--showformat", "${Package}, ${Provides}\n").splitlines()
        packages = [line.split(",")[0] for line in installed if not {*re.split("[ ,]+", line)}.isdisjoint(linked)]
        there = {Path(file).name for file in run("dpkg", "-L", *packages).splitlines()}
        needed = re.findall(r"NEEDED\s+(\S+)", run("objdump", "-p", FROXEL))
        self.assertIn("libpng16.so.16", needed)
        self.assertLessEqual(set(needed), there)

    def test_compose_agrees_with_the_binary(self):
        compose = yaml.safe_load((DEPLOY / "compose.yaml").read_text())
        froxel = compose["services"]["froxel"]
        self.assert_variables(froxel["environment"])
        self.assertTrue(froxel["ports"][0].endswith(f":{self.service['port']}"))
        for service in compose["services"].values():
            self.assertIn("mem_limit", service)
            for port in service.get("ports", []):
                self.assertTrue(defaulted(port).startswith("127.0.0.1:"), port)
        self.assertEqual(froxel["expose"], [str(self.service["admin_port"])])
        scenes, = [volume for volume in froxel["volumes"] if "FROXEL_SCENES_FOLDER" in volume]
        self.assertTrue(scenes.endswith(f":{self.image_variable('FROXEL_SCENES')}:ro"))
        self.assertTrue((DEPLOY / defaulted(scenes).split(":")[0]).is_dir())
        self.assertGreater(seconds(froxel["stop_grace_period"]),
                           int(froxel["environment"]["FROXEL_DRAIN_SECONDS"]))
        overlay = yaml.safe_load((DEPLOY / "compose.nvidia.yaml").read_text())
        self.assert_variables(overlay["services"]["froxel"]["environment"])
        sign_in = yaml.safe_load((DEPLOY / "compose.signin.yaml").read_text())["services"]
        self.assert_variables(sign_in["froxel"]["environment"])
        for mount in sign_in["nginx"]["volumes"]:
            if mount.startswith("./"):
                self.assertTrue((DEPLOY / mount.split(":")[0]).is_file(), mount)
        address = sign_in["oauth2-proxy"]["environment"]["OAUTH2_PROXY_HTTP_ADDRESS"].split(":")[1]
        self.assertIn(f"oauth2-proxy:{address};", (DEPLOY / "nginx.signin.conf").read_text())
        scrape, = yaml.safe_load((DEPLOY / "compose/prometheus.yml").read_text())["scrape_configs"]
        self.assertEqual(scrape["static_configs"][0]["targets"],
                         [f"froxel:{self.service['admin_port']}"])

    def test_alerts_and_dashboard_use_metrics_that_there_are(self):
        sources = "".join(path.read_text() for path in (ROOT / "server/net").glob("*metrics.cpp"))
        metrics = set(re.findall(r'"((?:froxel|process)_[a-z0-9_]+)"', sources))
        texts = [(DEPLOY / "compose/alerts.yml").read_text()]
        dashboard = json.loads((DEPLOY / "compose/grafana/dashboards/froxel.json").read_text())
        for panel in dashboard["panels"]:
            texts += [target["expr"] for target in panel["targets"]]
        used = set(re.findall(r"\b((?:froxel|process)_[a-z0-9_]+)", " ".join(texts)))
        self.assertGreater(len(used), 10)
        self.assertEqual({re.sub("_bucket$", "", name) for name in used} - metrics, set())

    def test_alertmanager_takes_its_configuration(self):
        config = yaml.safe_load((DEPLOY / "compose/alertmanager.yml").read_text())
        alerts = (DEPLOY / "compose/alerts.yml").read_text()
        for rule in config["inhibit_rules"]:
            for source in re.findall(r'alertname="(\w+)"', " ".join(rule["source_matchers"])):
                self.assertIn(f"alert: {source}\n", alerts)
        if not shutil.which("amtool"):
            self.skipTest("amtool is not here (Debian: prometheus-alertmanager)")
        run("amtool", "check-config", DEPLOY / "compose/alertmanager.yml")

    def test_alerts_hold(self):
        if not shutil.which("promtool"):
            self.skipTest("promtool is not here (Debian: prometheus)")
        folder = DEPLOY / "compose"
        run("promtool", "check", "config", folder / "prometheus.yml")
        run("promtool", "test", "rules", folder / "alerts_test.yml")
        readme = (DEPLOY / "README.md").read_text()
        for name in re.findall(r"alert: (\w+)", (folder / "alerts.yml").read_text()):
            self.assertIn(f"`{name}`", readme)

    def test_alerts_watch_series_that_are_there_before_the_event(self):
        with fresh_server() as text:
            series = [(name, dict(re.findall(r'(\w+)="([^"]*)"', labels or "")))
                      for name, labels in re.findall(r"^([a-z_]+)(?:\{(.*)\})? ", text, re.M)]
        rules = yaml.safe_load((DEPLOY / "compose/alerts.yml").read_text())["groups"][0]["rules"]
        tests = yaml.safe_load((DEPLOY / "compose/alerts_test.yml").read_text())["tests"]
        watched = {rule["alert"]: rule["expr"] for rule in rules}
        watched |= {f"test of {test['name']}": " ".join(
            entry["series"] for entry in test["input_series"]) for test in tests}
        for alert, expression in watched.items():
            for name, labels in re.findall(r"\b((?:froxel|process)_\w+)\{([^}]*)\}", expression):
                wanted = dict(re.findall(r'(\w+)="([^"]*)"', labels))
                for given_by_prometheus in ("job", "instance"):
                    wanted.pop(given_by_prometheus, None)
                found = any(name == its_name and wanted.items() <= its_labels.items()
                            for its_name, its_labels in series)
                self.assertTrue(found, f"{alert}: a fresh server has no {name} with {wanted}")
        # Every alert with a counter behind it has been seen to fire.
        fired = {case["alertname"] for test in tests for case in test["alert_rule_test"]
                 if case["exp_alerts"]}
        self.assertLessEqual({"FroxelDown", "FroxelRestarts", "FroxelDeviceLost", "FroxelFull",
                              "FroxelRefusesViewers", "FroxelWrongTokens"}, fired)

    def test_autoscalers_use_metrics_that_the_adapter_gives(self):
        readme = (DEPLOY / "README.md").read_text()
        given = set(re.findall(r"name: \{as: (\w+)\}|seriesQuery: (froxel_device_load)\b", readme))
        given = {name for pair in given for name in pair if name}
        autoscaler = yaml.safe_load((DEPLOY / "kubernetes/components/autoscaler/autoscaler.yaml").read_text())
        used = {metric["pods"]["metric"]["name"] for metric in autoscaler["spec"]["metrics"]}
        self.assertIn("froxel_device_load", used)
        self.assertLessEqual(used, given)

    def test_unit_leaves_time_to_drain(self):
        unit = (DEPLOY / "systemd/froxel.service").read_text()
        drain = float(re.search(r"--drain-seconds (\d+)", unit)[1])
        self.assertGreater(seconds(re.search("TimeoutStopSec=(.*)", unit)[1]), drain)
        self.assert_variables(re.findall(r"FROXEL_[A-Z_]+", unit))
        self.assertIn(f"\n# {self.service['exit_code_device_lost']}: the device was lost.", unit)

    def test_unit_lets_scene_readers_give_up_their_rights(self):
        unit = (DEPLOY / "systemd/froxel.service").read_text()
        isolation = (ROOT / "server/bake/isolation.cpp").read_text()
        used = set(re.findall(r"SYS_(landlock_\w+|seccomp)\b", isolation))
        self.assertIn("seccomp", used)
        self.assertLessEqual(used, set(re.search("SystemCallFilter=(.*)", unit)[1].split()))

    def test_proxies_outlast_pings_and_ask_for_readiness(self):
        nginx = (DEPLOY / "nginx.conf").read_text()
        for name in ("proxy_read_timeout", "proxy_send_timeout"):
            self.assertGreater(seconds(re.search(name + " (.*);", nginx)[1]),
                               self.service["idle_timeout_seconds"])
        haproxy = (DEPLOY / "haproxy.cfg").read_text()
        for name in ("client", "server", "tunnel"):
            self.assertGreater(seconds(re.search(f"timeout {name} (.*)", haproxy)[1]),
                               self.service["idle_timeout_seconds"])
        self.assertIn(f"option httpchk GET {self.service['ready_path']}\n", haproxy)
        self.assertIn(f"check port {self.service['admin_port']} ", haproxy)
        for text in (nginx, haproxy):
            self.assertIn(f"froxel-a:{self.service['port']}", text)


# Debian's package of what CMakeLists.txt ask for, as deploy/common.sh names it; None: comes with another.
PACKAGES = {
    "Boost": "libboost-url1.81-dev|libboost-url-dev", "CLI11": "libcli11-dev", "GTest": "libgtest-dev",
    "OpenEXR": "libopenexr-dev", "OpenSSL": "libssl-dev", "PNG": "libpng-dev", "PkgConfig": "pkg-config", "Poco": "libpoco-dev",
    "Protobuf": "libprotobuf-dev", "Python3": "python3", "Threads": None, "TinyGLTF": "libtinygltf-dev",
    "Vulkan": "libvulkan-dev", "ZLIB": None, "benchmark": "libbenchmark-dev", "draco": "libdraco-dev",
    "glm": "libglm-dev", "glslangValidator": "glslang-tools", "libturbojpeg": "libturbojpeg0-dev",
    "lib3mf": "lib3mf-dev", "tinyobjloader": "libtinyobjloader-dev", "libmatroska": "libmatroska-dev", "libseccomp": "libseccomp-dev", "libwebp": "libwebp-dev", "libzstd": "libzstd-dev",
    "meshoptimizer": "libmeshoptimizer-dev", "nlohmann_json": "nlohmann-json3-dev",
    "prometheus-cpp-core": "prometheus-cpp-dev", "spdlog": "libspdlog-dev", "spirv-val": "spirv-tools", "stb": "libstb-dev",
    "tomlplusplus": "libtomlplusplus-dev", "vpx": "libvpx-dev", "wasm2c": "wabt",
}


class Packages(unittest.TestCase):
    @unittest.skipUnless(shutil.which("dpkg-shlibdeps"), "no dpkg-shlibdeps")
    def test_third_party_list_is_what_the_binary_is_built_from(self):
        told = (ROOT / "THIRD_PARTY.md").read_text()
        made = run(sys.executable, DEPLOY / "notices.py", FROXEL)
        # Sources with a version in their name differ from release to release of Debian.
        unversioned = [re.sub(r"^(\| `(?:boost|gcc-))[\d.]+`", r"\1`", text, flags=re.M) for text in (told, made)]
        self.assertEqual(*unversioned, "deploy/notices.py BINARY >THIRD_PARTY.md")
        self.assertIn("/usr/local/share/doc/froxel/THIRD_PARTY.md", (DEPLOY / "Dockerfile").read_text())

    def test_install_list_has_what_cmake_asks_for(self):
        asked = set()
        for folder in (ROOT / "CMakeLists.txt", *ROOT.glob("server/**/CMakeLists.txt"),
                       *ROOT.glob("shaders/**/CMakeLists.txt"), *ROOT.glob("tests/**/CMakeLists.txt")):
            text = folder.read_text()
            asked |= set(re.findall(r"find_package\((\w+)", text))
            asked |= set(re.findall(r"pkg_check_modules\(\w+ REQUIRED IMPORTED_TARGET ([\w-]+)", text))
            asked |= set(re.findall(r"find_program\(\w+ ([\w-]+) REQUIRED\)", text))
            asked |= set(re.findall(r"find_path\((\w+)_headers", text))
        self.assertIn("libzstd", asked)  # or nothing is found
        listed = run("bash", "-c", f"source {DEPLOY}/common.sh && "
                     "printf '%s\\n' \"${build_packages[@]}\" \"${test_packages[@]}\"").split()
        for name in sorted(asked):
            self.assertIn(name, PACKAGES, "say here which package it is of")
            if PACKAGES[name]:
                self.assertIn(PACKAGES[name], listed, f"deploy/common.sh lacks the package of {name}")


if __name__ == "__main__":
    told_skips.main()
