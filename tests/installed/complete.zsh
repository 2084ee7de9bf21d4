# What zsh is told to offer for the last of the words of a command line: complete.zsh SCRIPT vehd run --
script=$1
shift
words=("$@")
CURRENT=$#
PREFIX=${words[-1]}
_describe() {
  [ "$1" = -o ] && shift
  print -l -- "${(@P)2}"
}
_files() { print files }
source $script
true
