"""The Debian package that `cpack` makes: what it holds, what it depends on, and that it runs where it is unpacked."""

import unittest

from installed import BUILD, Installed, run

HOLDS = """./usr/bin/tether -> ../libexec/tether/tether
./usr/libexec/tether/fluid
./usr/libexec/tether/solid
./usr/libexec/tether/fsi_master
./usr/libexec/tether/identification_master
./usr/libexec/tether/observation_manager
./usr/libexec/tether/tether_picture
./usr/libexec/tether/tether_conform
./usr/include/tether.h
./usr/lib/libtether_client.so
./usr/lib/cmake/Tether/TetherConfig.cmake
./usr/lib/python3/dist-packages/tether
./usr/share/tether/configs/tube/case.yaml
./usr/share/doc/tether/docs/guide.md
./usr/share/doc/tether/copyright"""


class Package(Installed):
    def test_holds_what_it_should_and_runs(self):
        run(["cpack", "--config", BUILD / "CPackConfig.cmake", "-B", self.root / "made"], self.root)
        (package,) = (self.root / "made").glob("*.deb")
        content = run(["dpkg-deb", "-c", package], self.root)
        for name in HOLDS.splitlines():
            self.assertIn(name, content)
        depends = run(["dpkg-deb", "-f", package, "Depends"], self.root)
        for name in ("libc6", "libopenmpi3", "openmpi-bin", "libvtk9.1", "libyaml-cpp0.7"):
            self.assertIn(name, depends)
        run(["dpkg-deb", "-x", package, self.root / "unpacked"], self.root)
        self.runs_cases(self.root / "unpacked/usr")


if __name__ == "__main__":
    unittest.main()
