"""Words that people use for the columns of a motor's log, in the languages such logs were found in."""

from enum import Enum
from math import pi, radians


class Quantity(str, Enum):
    """What a column holds."""

    TIME = "time"
    VOLTAGE = "voltage"
    DUTY = "duty"
    SUPPLY = "supply voltage"
    CURRENT = "current"
    SPEED = "speed"
    POSITION = "position"
    COUNT = "count"
    REFERENCE = "reference"
    OTHER = "other"


def words_of(words: str) -> frozenset[str]:
    """The words of a line."""
    return frozenset(words.split())


_row = words_of


# Of a system: what drives it, or a controller.
INPUTS = _row("input entrada eingang entrée entree ingresso masukan giriş wejście vstup вход")
OUTPUTS = _row("output saída saida salida ausgang sortie uscita keluaran çıkış wyjście výstup выход")

RAW = _row("raw unfiltered roh brut crudo bruto")
FILTERED = _row(
    "filtered filt filter smooth smoothed avg average averaged mean lpf ema ma kalman est estimate estimated fir"
)
MEASURED = _row(
    "meas measured measurement medido medida feedback fb actual ist istwert pv messwert mesure mesuré mesurée misura "
    "misurato misurata gemessen ölçülen zmierzona měřená 实际 测量 反馈 当前 実際"
)
# What a motor moves, and what moves on by itself: its angle is not the shaft's.
BODIES = _row(
    "pendulum pend pendulo péndulo pêndulo pendel pendule pendolo wahadło wahadlo sarkaç маятник beam ball cart"
)
# Of words that are written together, these come last: Motordrehzahl, Sollspannung.
TAILS = _row(
    "drehzahl spannung geschwindigkeit strom winkel zeit temperatur sollwert istwert spanning snelheid toerental "
    "hastighet hastighed spænding spänning"
)

# Which way a drive goes that has no sign.
DIRECTIONS = _row("dir direction drehrichtung richtung sentido sens reverse reversed ccw cw")

# How long something takes: a loop, a row. No motor is driven by it.
DURATIONS = _row(
    "delay dt ts period latency interval retardo retraso periodo período atraso période periode délai verzögerung "
    "abtastzeit ritardo opóźnienie okres gecikme zpoždění"
)

# What is written to a timer, or a share by its name; a command of another name may be in volts.
SHARES = _row(
    "duty pwm dutycycle throttle power шим 占空比 듀티 cyclique tastgrad tastverhältnis wypełnienie wypelnienie střída "
    "strida doluluk umplere скважность effort esforço esforco esfuerzo"
)
VOLTAGE_WORDS = _row("voltage volt volts voltaje spannung tension tensión")

# Earlier rows win: a target speed is no speed, a battery's voltage is not the motor's, a speed command is a reference.
WORDS: dict[Quantity, frozenset[str]] = {
    Quantity.OTHER: _row(
        "error err erro fehler erreur errore galat kp ki kd integral gyro temp temperature accel acceleration "
        "temperatur temperatura température temperatuur teplota suhu sıcaklık 温度 estado état zustand stato "
        "acc derivative id index loop state mode enabled fault limited saturated lead integrator wcs acs shunt torque "
        "cell cells loadcell loadcells strain "  # a test stand's: a strain gauge's millivolts drive nothing
        "gain gains couple drehmoment moment coppia torsione kraft force écart ecart écarts ecarts uchyb odchylka "
        "regelabweichung "
        "heading dir direction drehrichtung richtung yaw pitch roll rate "
        "efficiency eficiencia eficiência rendement rendimiento rendimento rendimenti wirkungsgrad efficienza verim "
        "sprawność účinnost humidity soc score zscore"
    ),
    Quantity.REFERENCE: _row(
        "ideal target sollwert consigne referencia referência référence referenz riferimento setpoint set sp ref "
        "reference desired goal soll consigna r wanted demand profile referans hedef zadana žádaná zadaná deseado "
        "deseada yr yref wref uref desejado desejada objetivo acuan vorgabe führungsgröße заданная 目标 目標 设定 期望"
    ),
    Quantity.SUPPLY: _row(
        "supply battery batt bat vbat vbatt vbus bus akku bateria batería batterie vcc vdd vin versorgungs "
        "alimentation alimentación alimentacion alimentação alimentazione zasilanie napájení besleme 供电 电源 電源"
    ),
    Quantity.TIME: _row(
        "timestep timesteps "
        "t time times timp waktu 시간 timestamp stamp tiempo zeit temps tps date tempo tid clock elapsed second "
        "heure hora uhrzeit ora tijdstip "
        "seconds secs sec sekunde sekunden segundo segundos seconde secondes secondi saniye detik millis micros nanos "
        "milliseconds microseconds ms us ns tijd czas čas cas idő zaman время 时间 時間"
    ),
    Quantity.DUTY: OUTPUTS
    | _row(
        "duty pwm esforço esforco esfuerzo mando comando stellgröße stellgroesse шим 占空比 듀티 dutycycle throttle "
        "power command cmd effort ctrl control commande stellwert tastgrad tastverhältnis cyclique sterowanie "
        "wypełnienie wypelnienie střída strida kontrol kendali doluluk akční akcni umplere управление скважность 控制 "
        "控制量 制御"
    ),
    Quantity.COUNT: _row(
        "count counts pulsos impulsos impulse cuentas contagem contador tick ticks encoder enc pulses pulse edges qei"
    ),
    Quantity.SPEED: _row(
        "speed velocity vel velocidad velocidade geschwindigkeit drehzahl vitesse velocità omega ω w wm rpm rps "
        "dps erpm tacho tachometer vit turatie turație putaran devir sebesség velocita "
        "snelheid viteza viteză kecepatan 속도 toerental hastighed hastighet "
        "prędkość predkosc obroty rychlost otáčky otacky hız hiz скорость обороты 速度 转速 角速度 回転数"
    ),
    Quantity.POSITION: _row(
        "position pos posición posicion posizione angle angulo ángulo theta θ winkel distance dist phi posição "
        "posicao posisi sudut poziție pozitie unghi 위치 각도 ângulo angolo hoek pozycja kąt kat poloha úhel uhel "
        "konum açı aci угол положение 位置 角度"
    ),
    Quantity.VOLTAGE: INPUTS
    | _row(
        "sine sinewave chirp ramp stair stairs staircase prbs aprbs sweep excitation stimulus "
        "voltage volt volts voltaje spannung tension tensión tensão u v vm vmotor applied tensao tensione "
        "tegangan tensiune 전압 spanning spænding spänning napięcie napiecie napětí napeti gerilim voltaj "
        "напряжение 电压 電圧"
    ),
    Quantity.CURRENT: _row(
        "current curr arus 전류 amps amp i corriente strom courant corrente stroom prąd proud akım ток 电流 電流"
    ),
}
MOVES = frozenset({Quantity.SPEED, Quantity.POSITION, Quantity.COUNT})

# What one unit is: seconds as nanoseconds, volts, A, rad/s, rad; None where something else says (the encoder, a wheel).
UNITS: dict[str, tuple[Quantity, float | None]] = {
    "s": (Quantity.TIME, 1e9),
    "ms": (Quantity.TIME, 1e6),
    "us": (Quantity.TIME, 1e3),
    "ns": (Quantity.TIME, 1.0),
    "V": (Quantity.VOLTAGE, 1.0),
    "mV": (Quantity.VOLTAGE, 1e-3),
    "A": (Quantity.CURRENT, 1.0),
    "mA": (Quantity.CURRENT, 1e-3),
    "%": (Quantity.DUTY, None),
    "rad/s": (Quantity.SPEED, 1.0),
    "deg/s": (Quantity.SPEED, radians(1.0)),
    "rpm": (Quantity.SPEED, 2.0 * pi / 60.0),
    "rev/s": (Quantity.SPEED, 2.0 * pi),
    "count/s": (Quantity.SPEED, None),
    "krpm": (Quantity.SPEED, 2000.0 * pi / 60.0),
    "m/s": (Quantity.SPEED, None),
    "cm/s": (Quantity.SPEED, None),
    "mm/s": (Quantity.SPEED, None),
    "km/h": (Quantity.SPEED, None),
    "in/s": (Quantity.SPEED, None),
    "ft/s": (Quantity.SPEED, None),
    "rad": (Quantity.POSITION, 1.0),
    "deg": (Quantity.POSITION, radians(1.0)),
    "rev": (Quantity.POSITION, 2.0 * pi),
    "m": (Quantity.POSITION, None),
    "cm": (Quantity.POSITION, None),
    "mm": (Quantity.POSITION, None),
    "in": (Quantity.POSITION, None),
    "ft": (Quantity.POSITION, None),
    "count": (Quantity.COUNT, None),
}
_SPELLINGS = {
    "s": "с сек seg seg. s sec secs second seconds",
    "ms": "мс ms msec msecs millis millisecond milliseconds",
    "us": "us µs μs usec micros microsecond microseconds",
    "ns": "ns nsec nanos nanosecond nanoseconds",
    "V": "v в volt volts",
    "mV": "mv millivolt millivolts",
    "A": "a amp amps ampere",
    "mA": "ma",
    "%": "% pct percent percentage porcentaje porcentagem pourcentage percentuale prozent procent persen yüzde процент",
    "rad/s": "rad/s rad/seg рад/с рад_с rad/sec rads rads/s radps rad.s-1 rad_s rad_sec",
    "deg/s": "deg/s grados/seg град/с град_с deg/sec °/s grad/s grados/s graus/s dps degps degrees/s deg_s deg_sec",
    "rpm": (
        "tr/mn trs/min tours/min d/dk "
        "erpm rpm upm rev/min rev_min u/min tr/min r/min 1/min min-1 umdr/min giri/min ot/min obr/min obr_min об/мин "
        "об_мин"
    ),
    "rev/s": "rps rev/s r/s rotations/s turns/s hz rev_s",
    "count/s": (
        "count/s counts/s tick/s ticks/s step/s steps/s pulse/s pulses/s edges/s cps pps count_s counts_s ticks_s"
    ),
    "krpm": "krpm",
    "cm/s": "cm/s cm_s cmps cm/sec",
    "mm/s": "mm/s mm_s mmps mm/sec",
    "km/h": "km/h km_h kmh kmph kph",
    "in/s": "in/s in/sec ips inch/s inch/sec inches/s inches/sec",
    "ft/s": "ft/s ft/sec fps feet/s feet/sec",
    "in": "inch inches",
    "ft": "ft feet foot",
    "cm": "cm centimeter centimeters",
    "mm": "mm millimeter millimeters",
    "m/s": "m/s m/sec mps m_s meters/s metres/s",
    "rad": "rad рад radian radians",
    "deg": "deg град grad grados graus gradi degs degree degrees degré degrés dégré dégrés degres derece derajat °",
    "rev": "rev revs turn turns rotation rotations revolutions",
    "m": "m meter meters metre metres",
    "count": "count counts tick ticks pulse pulses edges pt pts points top tops imp impulsions",
}
# Counts, where they stand in brackets: `qc` are quadcounts; words of a name elsewhere, such as `time steps`.
COUNTS_IN_BRACKETS = _row("steps qc inc incs increments inkremente pulsos cuentas impulsos impulse impulses tics pasos")
# Units, in brackets, of what is neither a motor's drive nor its motion.
OF_OTHERS = _row(
    "nm n.m n·m mnm n·mm ncm nmm kgf gf n kn lbf lb lbs oz g °c ºc degc w mw kw pa kpa bar mbar wh mah ah j nm/a °c/w"
)
UNIT_BY_SPELLING = {spelling: unit for unit, row in _SPELLINGS.items() for spelling in row.split()}

SIDES = {
    **dict.fromkeys(_row("left l lft izq izquierda links gauche"), "left"),
    **dict.fromkeys(_row("right rgt der derecha rechts droite"), "right"),
}
