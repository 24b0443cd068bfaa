#!/usr/bin/env bash
# Installs the package of croon in a bare system of the release that it was built on, and calibrates a simulated car there.
# Usage: deb_test.sh [DEB], by default the file that CROON_DEB names. Needs root, debootstrap and the network, and ends with
# 77 without them or without a package. The bare system is kept in CROON_CHROOTS (default: croon_chroots in the folder of
# temporary files) and copied for each test.
set -euo pipefail

skip() { echo "deb_test: $*" >&2; exit 77; }
fail() { echo "deb_test: $*" >&2; exit 1; }

deb=${1:-${CROON_DEB:-}}
[[ -n $deb ]] || skip 'no package was given; make package-test gives one'
[[ -f $deb ]] || fail "no such file: $deb"
[[ $(id -u) -eq 0 ]] || skip 'a chroot needs root'
PATH=$PATH:/usr/sbin:/sbin
command -v debootstrap >/dev/null || skip 'debootstrap is not installed'

# The mirror that this system itself is installed from.
release=$(. /etc/os-release && echo "$VERSION_CODENAME")
mirror=$(apt-get indextargets --format '$(CODENAME) $(REPO_URI)' 'Created-By: Packages' |
  awk -v release="$release" '$1 == release {print $2; exit}')
[[ -n $mirror ]] || skip "apt knows no mirror of $release; apt-get update may help"

chroots=${CROON_CHROOTS:-${TMPDIR:-/tmp}/croon_chroots}
base=$chroots/$release
mkdir -p "$chroots"
if [[ ! -d $base ]]; then
  partial=$(mktemp -d "$chroots/partial.XXXXXX")
  if ! debootstrap --variant=minbase "$release" "$partial" "$mirror" >"$chroots/debootstrap.log" 2>&1; then
    rm -rf "$partial"
    tail -n 3 "$chroots/debootstrap.log" >&2
    skip "debootstrap cannot make a system of $release"
  fi
  chmod 755 "$partial"
  mv "$partial" "$base"
fi

root=$(mktemp -d "$chroots/test.XXXXXX")
leave() {
  for mounted in proc dev; do
    if mountpoint -q "$root/$mounted"; then umount "$root/$mounted"; fi
  done
  rm -rf --one-file-system "$root"
}
trap leave EXIT
trap 'exit 1' INT TERM
cp -a "$base/." "$root"
mount -t proc proc "$root/proc" || skip 'proc cannot be mounted in a chroot here'
mount --bind /dev "$root/dev" || skip 'the devices cannot be mounted in a chroot here'
# As this system reaches the mirror: its lists of sources, proxies and keys.
cp /etc/resolv.conf "$root/etc/resolv.conf"
rm -rf "$root/etc/apt/sources.list" "$root/etc/apt/sources.list.d"
for file in sources.list sources.list.d apt.conf apt.conf.d trusted.gpg.d keyrings auth.conf.d; do
  if [[ -e /etc/apt/$file ]]; then cp -a "/etc/apt/$file" "$root/etc/apt/"; fi
done
cp "$deb" "$root/croon.deb"

in_root() { chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/tmp LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive "$@"; }

in_root apt-get update -qq || skip 'the network is not there'
in_root apt-get install -y -qq --no-install-recommends /croon.deb >"$chroots/install.log" 2>&1 ||
  { tail -n 20 "$chroots/install.log" >&2; fail 'apt does not install the package'; }
for left_out in /usr/include/croon /usr/lib/libcroon_framework.a /usr/lib/cmake/croon; do
  [[ ! -e $root$left_out ]] || fail "the package has $left_out"
done
[[ -s $root/usr/share/doc/croon/copyright ]] || fail 'the package has no copyright file'

cat >"$root/tmp/use.sh" <<'END'
set -euo pipefail
cd "$(mktemp -d)"
croon --version
croon validate /usr/share/croon/experiments >/dev/null
examples=/usr/share/doc/croon/examples
croon simulate "$examples/car.json" --out car --quiet >/dev/null
# The stages that use OpenVDB load their module from beside the program.
sed 's/"ground_alignment"/"volume_refinement", "scorer": {"type": "openvdb_grid"}/' "$examples/car.json" >openvdb.json
croon run openvdb.json --out openvdb --quiet >/dev/null
# Five PCD files, no initial guess.
croon calibrate car/000000/top.pcd car/000000/left.pcd car/000000/right.pcd --out result
test -s result/extrinsics.json
python3 -c 'import croon; print(croon.__version__, *croon.pipelines())'
python3 "$examples/calibrate.py" saved
grep '^left,accepted,' saved/extrinsics.csv
END
in_root bash /tmp/use.sh || fail 'the installed package does not calibrate a simulated car'
echo 'The package installs on a bare system and calibrates a simulated car there.'
