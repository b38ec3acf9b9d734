"""Names of columns, as they were found in logs."""

import pytest

from motor_identification.logs.columns.heading import is_of_joint_states, read_heading
from motor_identification.logs.columns.vocabulary import Quantity

ROWS = """
t                 | time           |       |
time [ms]         | time           | ms    |
Tiempo (s)        | time           | s     |
time_us           | time           | us    |
t_s               | time           | s     |
elapsed ms        | time           | ms    |
Timestamp         | time           |       |
PWM               | duty           |       |
duty_pct          | duty           | %     |
motorCommand      | duty           |       |
leftCommand       | duty           |       | left
u                 | voltage        |       |
Voltaje (V)       | voltage        | V     |
motor_voltage     | voltage        |       |
cmd_voltage       | voltage        |       |
Spannung          | voltage        |       |
batteryVoltage    | supply voltage |       |
Battery [mV]      | supply voltage | mV    |
Velocidad (rad/s) | speed          | rad/s |
timestep (8Hz)    | time           |       |
rotation (Hz)     | speed          | rev/s |
écart 1 (mm)      | other          | mm    |
Couple Moteur [Nm] | other         |       |
effort (N)        | other          |       |
Heure             | time           |       |
erpm              | speed          | rpm   |
Axis0_Pos_gain    | other          |       |
timestep (8 kHz)  | time           |       |
enconder(steps)   | count          | count |
Position [qc]     | count          | count |
time steps        | time           |       |
Speed (steps/s)   | speed          | count/s |
Speed (furlongs/s) | speed         |       |
tacho             | speed          |       |
pitch_effort      | duty           |       |
pitch_velocity    | speed          |       |
yaw_duty_cycle    | duty           |       |
pitch PWM         | duty           |       |
roll_voltage      | voltage        |       |
yaw_pwm_error     | other          |       |
pitch_command     | other          |       |
pitch rate        | other          |       |
pitch_angle       | other          |       |
leftSpeedRpm      | speed          | rpm   | left
rpm_actual        | speed          | rpm   |
RPM_Motor_DC      | speed          | rpm   |
rpm_target        | reference      |       |
omega_rad_s_filt  | speed          | rad/s |
angle deg meas    | position       | deg   |
rotation speed meas | speed        |       |
Temperatur        | other          |       |
r_speed           | speed          |       | right
Rspeed            | speed          |       | right
Lspeed            | speed          |       | left
lpos_deg          | position       | deg   | left
RControl          | duty           |       | right
RPWM              |                |       |
load              |                |       |
vel_rad_s         | speed          | rad/s |
Drehzahl [1/min]  | speed          | rpm   |
v_l (ips)         | speed          | in/s  | left
velocity [ft/s]   | speed          | ft/s  |
position_inches   | position       | in    |
pwm_in            | duty           |       |
M1 speed          | speed          |       | 1
ω (rad/s)         | speed          | rad/s |
pos_deg           | position       | deg   |
Position (m)      | position       | m     |
theta             | position       |       |
encoder_count     | count          | count |
velocity_encoder  | speed          |       |
encoder_ticks_speed | count        |       |
encoder position  | count          |       |
wheel_left_ticks  | count          | count | left
I (A)             | current        | A     |
targetSpeed       | reference      |       |
current_mA        | current        | mA    |
batt_mV           | supply voltage | mV    |
velocityRadPerSec | speed          | rad/s |
omega_degPerSec   | speed          | deg/s |
deg_per_s         | speed          | deg/s |
counts_per_second | speed          | count/s |
rev_per_min       | speed          | rpm   |
wheel turns per minute | speed     | rpm   |
theta_dot         | speed          |       |
velocity_rad      | speed          | rad/s |
speed (deg)       | speed          | deg/s |
vel_rad_left      | speed          | rad/s | left
pwm_step.speed    | speed          |       |
speed_test.u      | voltage        |       |
d.samplingT1.w_meas | speed        |       |
d.samplingT1.th   |                |       |
d.samplingT1.t    | time           |       |
time.s            | time           | s     |
Temps.s           | time           | s     |
stamp.nanosec     | time           |       |
voltage.command   | voltage        |       |
time.data         | time           |       |
reference.speed   | reference      |       |
motor.speed.values | speed         |       |
battery.voltage   | supply voltage |       |
speed.output      | duty           |       |
Time.1            | time           |       |
theta_dot [rad]   | speed          | rad/s |
phi_dot1          | speed          |       |
theta_dot_left    | speed          |       | left
thetadot          | speed          |       |
Winkelgeschwindigkeit (rad) | speed | rad/s |
rpm_rad           | speed          | rad/s |
velocity_mm       | speed          | mm/s  |
speed [m]         | speed          | m/s   |
speed_m           | speed          |       |
speed_rev         | speed          |       |
speed_in          | speed          |       |
target_speed_rad  | reference      | rad/s |
speed_angle_rad   | position       | rad   |
speed_count       | count          | count |
Temps [ms]        | time           | ms    |
Tps [ms]          | time           | ms    |
Consigne [pt]     | reference      | count |
Mesure [pt]       | count          | count |
Commande [pt]     | duty           | count |
COMMANDE [Volts]  | voltage        | V     |
PWM [ticks]       | duty           | count |
output counts     | count          | count |
Status_DutyCycle_V1 | duty         |       | 1
Status_RPM_V1     | speed          | rpm   | 1
TotalCurrent_V2   | current        |       | 2
motor_V1          | voltage        |       |
V1                | voltage        |       |
ESC signal        | duty           |       |
ESC signal (µs)   | duty           | us    |
ESC 1 signal      | duty           |       |
Servo 3 (µs)      | duty           | us    |
pwm_us            | duty           | us    |
Throttle (µs)     | duty           | us    |
pwm period us     | time           | us    |
command_us        | time           | us    |
Left Load Cell (mV) | other        | mV    | left
ESC speed         | speed          |       |
ESC voltage (V)   | voltage        | V     |
ESC temperature   | other          |       |
Motor Efficiency (%) | other       | %     |
Wirkungsgrad [%]  | other          | %     |
Motor (%)         | duty           | %     |
Thrust (gf)       | other          |       |
idealLinearSpeed  | reference      |       |
output_speed      | speed          |       |
outputVelocity    | speed          |       |
output angle      | position       |       |
speed_output      | duty           |       |
pwm output speed  | duty           |       |
velocidad_salida  | duty           |       |
Commande vitesse  | reference      |       |
POSITION [degrés] | position       | deg   |
VIT. MOTEUR [rad/sec] | speed      | rad/s |
Velocidad angular [rad /seg] | speed | rad/s |
Tiempo [Seg.]     | time           | s     |
rapport cyclique  | duty           |       |
Sine Wave1        | voltage        |       |
Chirp Signal      | voltage        |       |
wcs2_raw_volt     | other          | V     |
Motordrehzahl [1/min] | speed      | rpm   |
Solldrehzahl      | reference      |       |
Drehzahlsollwert  | reference      |       |
Winkelgeschwindigkeit | speed      |       |
Ankerspannung     | voltage        |       |
Versorgungsspannung | supply voltage |     |
目标转速          | reference      |       |
实际转速(rpm)     | speed          | rpm   |
电机电压          | voltage        |       |
Hedef hız         | reference      |       |
Tensão (V)        | voltage        | V     |
Esforço           | duty           |       |
Referência        | reference      |       |
Fehler            | other          |       |
Winkel [Grad]     | position       | deg   |
Drehzahl [U/min]  | speed          | rpm   |
Velocidad (grados/s) | speed       | deg/s |
Kecepatan (RPM)   | speed          | rpm   |
Masukan           | voltage        |       |
Keluaran          | duty           |       |
waktu (ms)        | time           | ms    |
pulsos            | count          |       |
MV                | duty           |       |
mV                | voltage        | mV    |
prędkość [obr/min] | speed         | rpm   |
rpm_left          | speed          | rpm   | left
rpmR              | speed          | rpm   | right
l_vel_deg_s_right | speed          | deg/s | left
pwm_rev           | duty           | rev   |
position_rev      | position       | rev   |
speed_cm_s        | speed          | cm/s  |
Belt speed (mm/s) | speed          | mm/s  |
speed kmh         | speed          | km/h  |
position_mm       | position       | mm    |
ω, рад/с          | speed          | rad/s |
время, мс         | time           | ms    |
Prędkość [rpm]    | speed          | rpm   |
время             | time           |       |
转速 (rpm)        | speed          | rpm   |
Hoek (deg)        | position       | deg   |
speed_cmd         | reference      |       |
r                 | reference      |       |
temperature       | other          |       |
Test #            | other          |       |
trial_no          | other          |       |
speed test        | speed          |       |
Z_Score_Tach Reading (RPM) | other |  rpm  |
y                 |                |       |
column 2          |                |       |
"""


@pytest.mark.parametrize("row", ROWS.strip().splitlines())
def test_a_name_tells_quantity_unit_and_side(row: str) -> None:
    name, quantity, unit, side = (f"{row}|".split("|")[k].strip() for k in range(4))
    heading = read_heading(name)
    assert (heading.quantity.value if heading.quantity else "", heading.unit, heading.side) == (quantity, unit, side)


def test_earlier_quantities_win() -> None:
    assert read_heading("battery voltage").quantity is Quantity.SUPPLY
    assert read_heading("speed error").quantity is Quantity.OTHER
    assert read_heading("pwm voltage").quantity is Quantity.VOLTAGE


@pytest.mark.parametrize(
    ("name", "joint"),
    [
        ("/joint_states/arm/position", True),
        ("joint_states.velocity[0]", True),
        ("JointState_position", True),
        ("joint position", False),
        ("states/joint/position", False),
    ],
)
def test_names_of_joint_states(name: str, joint: bool) -> None:
    assert is_of_joint_states(read_heading(name)) == joint


@pytest.mark.parametrize("name", ["PWM_porcentaje", "duty (percentage)", "Stellwert Prozent", "pwm_pct"])
def test_per_cent_in_other_words(name: str) -> None:
    assert (read_heading(name).unit, read_heading(name).quantity) == ("%", Quantity.DUTY)
