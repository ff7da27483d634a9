# A bare Debian in a folder; sourced by the scripts that check something in one. They need root and debootstrap.

say() { printf '\n=== %s\n' "$*"; }

# The mirror that this machine's apt uses. One holds all releases: that of this machine's, if it does not name the other.
mirror_of() {
  local own_release
  own_release=$(. /etc/os-release && echo "$VERSION_CODENAME")
  apt-get indextargets --format '$(REPO_URI) $(CODENAME)' 'Created-By: Packages' |
    awk -v c="$1" -v own="$own_release" '$2 == c { print $1; found = 1; exit } $2 == own { m = $1 }
      END { if (!found && m != "") print m }'
}

# prepare_bare RELEASE FOLDER: a bare bookworm (Debian 12) or trixie (13) in a folder, where none is there yet, with this
# machine's way to the mirror, in $folder. Without FOLDER it is one in /tmp, which is removed when the script ends.
prepare_bare() {
  local release=$1 mirror extra=()
  case "$release" in
    bookworm | trixie) ;;
    *) echo "$release: must be bookworm (Debian 12) or trixie (Debian 13)" >&2; exit 2 ;;
  esac
  command -v debootstrap >/dev/null || { echo "needs debootstrap: apt-get install debootstrap" >&2; exit 1; }
  [ "$(id -u)" -eq 0 ] || { echo "needs root, for chroot" >&2; exit 1; }
  mirror=$(mirror_of "$release")
  [ -n "$mirror" ] || { echo "apt knows no mirror of $release here: run apt-get update" >&2; exit 1; }
  case "$mirror" in https:*) extra=(--include=ca-certificates) ;; esac
  folder=${2:-} is_own=
  if [ -z "$folder" ]; then
    folder=$(mktemp -d)
    chmod 755 "$folder"
    is_own=yes
  fi
  trap clear_up_bare EXIT
  if [ ! -e "$folder/etc/debian_version" ]; then
    say "making a bare $release"
    debootstrap --variant=minbase "${extra[@]}" "$release" "$folder" "$mirror" >/dev/null
  fi
  # Every Debian has it; without it files on their way have names, which a failed call may leave behind.
  mountpoint -q "$folder/proc" || mount -t proc proc "$folder/proc"
  # And pseudo-terminals, by which the QGIS plugin reads the program's progress.
  mkdir -p "$folder/dev/pts"
  mountpoint -q "$folder/dev/pts" || mount -t devpts -o newinstance,ptmxmode=0666,mode=0620 devpts "$folder/dev/pts"
  [ -e "$folder/dev/ptmx" ] || ln -s pts/ptmx "$folder/dev/ptmx"
  apt-config dump | grep -E '^Acquire::(http|https|Check|Proxy)' >"$folder/etc/apt/apt.conf.d/99machine" || true
  cp /etc/resolv.conf "$folder/etc/resolv.conf"
}

clear_up_bare() {
  local place
  for place in dev/pts proc; do
    if mountpoint -q "$folder/$place"; then umount "$folder/$place"; fi
  done
  if [ -n "$is_own" ]; then rm -rf --one-file-system "$folder"; fi
}

# run_in_bare PLACE COMMAND: in that folder of the bare system, with an empty environment.
run_in_bare() {
  env -i HOME=/root \
    PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin \
    chroot "$folder" /bin/bash -c "cd $1 && $2" </dev/null
}
